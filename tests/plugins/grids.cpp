// Functions by grid: a parameter of every type, in and out; what the arguments tell; errors.
#include "RslPlugin.h"

#include <stdexcept>
#include <string.h>

namespace {

int sum(RslContext*, int argc, const RslArg* argv[]) {
  if (argc != 10) return 1;
  RslFloatIter result(argv[0]), f(argv[1]);
  RslPointIter p(argv[2]);
  RslVectorIter v(argv[3]);
  RslNormalIter n(argv[4]);
  RslColorIter c(argv[5]);
  RslMatrixIter m(argv[6]);
  RslStringIter s(argv[7]);
  RslFloatArrayIter fs(argv[8]);
  RslColorArrayIter cs(argv[9]);
  for (unsigned int i = 0, count = RslArg::NumValues(argc, argv); i < count; ++i) {
    float total = 0, weight = 1;
    total += weight++ * *f;
    for (float* triple : {&(*p)[0], &(*v)[0], &(*n)[0], &(*c)[0]})
      for (int k = 0; k < 3; ++k)
        total += weight++ * triple[k];
    for (int k = 0; k < 16; ++k)
      total += weight++ * (*m)[k / 4][k % 4];
    total += weight++ * static_cast<float>(strlen(*s));
    for (int k = 0; k < fs.GetLength(); ++k)
      total += weight++ * fs[k];
    for (int k = 0; k < cs.GetLength(); ++k)
      for (int j = 0; j < 3; ++j)
        total += weight++ * (*cs)[k][j];
    *result = total;
    ++result, ++f, ++p, ++v, ++n, ++c, ++m, ++s, ++fs, cs++;
  }
  return 0;
}

int sum_float(RslContext*, int, const RslArg* argv[]) {
  RslFloatIter result(argv[0]), x(argv[1]);
  for (unsigned int i = 0; i < argv[0]->NumValues(); ++i, ++result, ++x)
    *result = 10 * *x;
  return 0;
}

int out(RslContext* context, int argc, const RslArg* argv[]) {
  RslFloatIter x(argv[1]), f(argv[2]);
  RslPointIter p(argv[3]);
  RslColorIter c(argv[4]);
  RslMatrixIter m(argv[5]);
  RslStringIter s(argv[6]);
  RslFloatArrayIter fs(argv[7]);
  RslStringArrayIter ss(argv[8]);
  for (unsigned int i = 0, count = RslArg::NumValues(argc, argv); i < count; ++i) {
    *f += *x;
    for (int k = 0; k < 3; ++k) {
      (*p)[k] = *x + static_cast<float>(k);
      (*c)[k] = *x * static_cast<float>(k + 1);
    }
    for (int k = 0; k < 16; ++k)
      (*m)[k / 4][k % 4] = *x + static_cast<float>(k);
    *s = const_cast<char*>(context->GetToken("written"));
    fs[0] = *x;
    fs[1] += 1;
    ss[1] = const_cast<char*>(context->GetToken("second"));
    ++x, ++f, ++p, ++c, ++m, ++s, ++fs, ++ss;
  }
  return 0;
}

// Largest value among the active points, as a uniform output.
int largest(RslContext*, int, const RslArg* argv[]) {
  RslFloatIter x(argv[1]), most(argv[2]);
  if (argv[2]->IsVarying()) return 2;
  *most = *x;
  for (unsigned int i = 0; i < argv[1]->NumValues(); ++i, ++x)
    if (*x > *most) *most = *x;
  return 0;
}

// What arguments say of themselves, as digits.
int describe(RslContext*, int, const RslArg* argv[]) {
  RslFloatIter result(argv[0]);
  const RslArg& a = *argv[1];
  float kind = a.IsFloat()    ? 1
               : a.IsPoint()  ? 2
               : a.IsVector() ? 3
               : a.IsNormal() ? 4
               : a.IsColor()  ? 5
               : a.IsMatrix() ? 6
               : a.IsString() ? 7
                              : 0;
  for (unsigned int i = 0; i < argv[0]->NumValues(); ++i, ++result)
    *result = kind + 10.0f * a.IsVarying() + 100.0f * a.IsArray() + 1000.0f * a.IsWriteable() +
              10000.0f * a.IsResizable() + 100000.0f * static_cast<float>(a.GetArrayLength()) +
              (strcmp(a.GetName(), "it") == 0 ? 0.5f : 0);
  return 0;
}

// The same as sum_float by raw data and run flags.
int raw(RslContext* context, int, const RslArg* argv[]) {
  unsigned int points;
  const RslRunFlag* flags = context->GetRunFlags(&points);
  float *to, *from;
  int to_stride, from_stride;
  argv[0]->GetData(&to, &to_stride);
  argv[1]->GetData(&from, &from_stride);
  for (unsigned int i = 0; i < points; ++i)
    if (flags[i])
      to[i * static_cast<unsigned>(to_stride)] = 10 * from[i * static_cast<unsigned>(from_stride)];
  return 0;
}

// 100 * active points + index of this one among them.
int order(RslContext*, int, const RslArg* argv[]) {
  RslFloatIter result(argv[0]);
  const unsigned int count = argv[0]->NumValues();
  for (unsigned int i = 0; i < count; ++i, ++result)
    *result = 100.0f * static_cast<float>(count) + static_cast<float>(i);
  return 0;
}

int fill(RslContext*, int, const RslArg* argv[]) {
  argv[2]->GetResizer()->Resize(static_cast<int>(*RslFloatIter(argv[1])));
  RslFloatArrayIter a(argv[2]);
  for (int k = 0; k < a.GetLength(); ++k)
    a[k] = static_cast<float>(k + 1);
  return 0;
}

// Of one's own data.
int offset(RslContext* context, int, const RslArg* argv[]) {
  static const float kOffset = 5;
  RslFloatIter result(argv[0]), x(argv[1]), own(&kOffset, context);
  for (unsigned int i = 0; i < argv[0]->NumValues(); ++i, ++result, ++x, ++own)
    *result = *x + *own;
  return 0;
}

// 0, 1, 4... so many.
int squares(RslContext*, int, const RslArg* argv[]) {
  RslFloatIter count(argv[1]);
  argv[0]->GetResizer()->Resize(static_cast<int>(*count));
  RslFloatArrayIter a(argv[0]);
  for (int k = 0; k < a.GetLength(); ++k)
    a[k] = static_cast<float>(k * k);
  return 0;
}
// A colour and its double.
int colors(RslContext*, int argc, const RslArg* argv[]) {
  RslColorArrayIter a(argv[0]);
  RslColorIter c(argv[1]);
  for (unsigned int i = 0; i < RslArg::NumValues(argc, argv); ++i, ++a, ++c)
    for (int k = 0; k < 3; ++k) {
      a[0][k] = (*c)[k];
      a[1][k] = 2 * (*c)[k];
    }
  return 0;
}

int fails(RslContext*, int, const RslArg*[]) {
  return 7;
}
int throws(RslContext*, int, const RslArg*[]) {
  throw std::runtime_error("out of cheese");
}

RslFunction functions[] = {
    {"float gr_sum(float, point, vector, normal, color, matrix, string, float[3], color[])", sum, NULL, NULL},
    {"float gr_sum(float x)", sum_float, NULL, NULL},
    {"void gr_out(float, output float, output point, output color, output matrix, output string, output "
     "float[2], "
     "output string[])",
     out, NULL, NULL},
    {"void gr_largest(varying float x, output uniform float most)", largest, NULL, NULL},
    {"float gr_describe(float it)", describe, NULL, NULL},
    {"float gr_describe(point other)", describe, NULL, NULL},
    {"float gr_describe(uniform color it)", describe, NULL, NULL},
    {"float gr_describe(string it)", describe, NULL, NULL},
    {"float gr_describe(float[] it)", describe, NULL, NULL},
    {"float gr_describe_out(output matrix it)", describe, NULL, NULL},
    {"float gr_describe_out(output float[] it)", describe, NULL, NULL},
    {"float gr_raw(float)", raw, NULL, NULL},
    {"varying float gr_order()", order, NULL, NULL},
    {"void gr_fill(uniform float, output uniform float[])", fill, NULL, NULL},
    {"float gr_offset(float)", offset, NULL, NULL},
    {"float gr_fails(float)", fails, NULL, NULL},
    {"float gr_throws(float)", throws, NULL, NULL},
    {"uniform float[] gr_array(uniform float)", squares, NULL, NULL},
    {"color[2] gr_colors(color c)", colors, NULL, NULL},
    NULL};

} // namespace

extern "C" {
RSLEXPORT RslFunctionTable RslPublicFunctions(functions);
}

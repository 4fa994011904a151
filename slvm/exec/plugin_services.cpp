// What sdk/rx.h offers plug-ins: noise by the machine's kernels, spaces and queries by the call under way.
#include "slvm/exec/observer.h"
#include "slvm/exec/plugin_call.h"
#include "slvm/exec/run.h"
#include "slvm/exec/spaces.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>

namespace slvm {
namespace {

constexpr int kMostNoiseDimensions = 4;

// Rows by kind, dimensions in (from 1) and out (1: float, 3: triple).
ShadeopId noise_row(int kind, int in, bool triple) {
  static constexpr const char* kNames[] = {"noise", "pnoise", "cellnoise"};
  static constexpr const char* kParams[2][kMostNoiseDimensions] = {
      {"float x", "float x, float y", "point p", "point p, float t"},
      {"float x, uniform float period", "float x, float y, uniform float xperiod, uniform float yperiod",
       "point p, uniform point period", "point p, float t, uniform point pperiod, uniform float tperiod"}};
  const std::string signature = std::string(triple ? "color(" : "float(") + kParams[kind == 1][in - 1] + ")";
  return static_cast<ShadeopId>(find_shadeop(kNames[kind], signature));
}

int noise(int kind, int in_dimension, const float* in, const float* period, int out_dimension, float* out) {
  if (kind < 0 || kind > 2 || in_dimension < 1 || in_dimension > kMostNoiseDimensions ||
      (out_dimension != 1 && out_dimension != 3) || !in || !out || (kind == 1 && !period))
    return -1;
  const Kernel kernel = kernel_table()[noise_row(kind, in_dimension, out_dimension == 3)];
  alignas(kPlaneAlign) std::array<float, (3 + 2 * kMostNoiseDimensions) * kMaxLanes> memory{};
  std::vector<Operand> operands{{memory.data(), kMaxLanes, 0, 1}};
  float* next = memory.data() + 3 * kMaxLanes;
  auto give = [&](const float* numbers) { // the first three of three or four are a point
    for (int done = 0; done < in_dimension;) {
      const int count = done == 0 && in_dimension >= 3 ? 3 : 1;
      operands.push_back({next, kMaxLanes, 0, 1});
      for (int i = 0; i < count; ++i, next += kMaxLanes)
        std::fill_n(next, kMaxLanes, numbers[done + i]);
      done += count;
    }
  };
  give(in);
  if (kind == 1) give(period);
  kernel(operands.data(), static_cast<uint32_t>(operands.size()), kMaxLanes, {});
  for (int i = 0; i < out_dimension; ++i)
    out[i] = operands[0].plane(static_cast<size_t>(i))[0];
  return 0;
}

int matrix(void* context, const char* from, const char* to, float* sixteen) {
  const GridCall* call = call_of(context);
  Matrix4 first, second;
  if (!call || !from || !to || !sixteen || !named_space(call->run, from, true, first) ||
      !named_space(call->run, to, false, second))
    return -1;
  const Matrix4 total = first * second;
  std::copy(total.m.begin(), total.m.end(), sixteen);
  return 0;
}

RxInfoType_t info_type(const Value& value) {
  if (value.integers) return RxInfoInteger;
  switch (value.type) {
  case Type::kColor: return RxInfoColor;
  case Type::kPoint: return RxInfoPoint;
  case Type::kVector: return RxInfoVector;
  case Type::kNormal: return RxInfoNormal;
  case Type::kMatrix: return RxInfoMatrix;
  case Type::kString: return RxInfoStringV;
  default: return RxInfoFloat;
  }
}

int query(void* context, int kind, const char* name, void* result, int length, RxInfoType_t* type,
          int* count) {
  const GridCall* call = call_of(context);
  if (!call || !name || !result) return -1;
  RendererServices& services = call->run.state.services;
  const ShadingState state = call->run.shading_state();
  Value value;
  const bool found = kind == 0   ? services.attribute(state, name, value)
                     : kind == 1 ? services.option(state, name, value)
                                 : services.renderer_info(state, name, value);
  if (!found) return -1;
  return give_value(*call, value, result, length, type, count);
}

int place(void* context, int* line, const char** file) {
  const GridCall* call = call_of(context);
  if (!call || !line || !file) return -1;
  const SourcePlace where = place_of(call->run.program, call->code);
  StringPool& strings = call->run.state.machine.strings();
  *line = static_cast<int>(where.line);
  *file = strings.text(strings.intern(where.line ? where.file : call->run.program.source_name)).data();
  return 0;
}

int missing(void* context, const char* function, const char* advice) {
  if (const GridCall* call = call_of(context))
    call->run.report(call->code, MessageSeverity::kWarning,
                     fmt::format("{} of a plug-in is not there: {}", function, advice), 1);
  return -1;
}

void* context_of_call(void* context) {
  return context ? static_cast<RixContext*>(static_cast<PluginContext*>(context)) : nullptr;
}

} // namespace

const GridCall* call_of(void* context) {
  return context ? static_cast<PluginContext*>(context)->call : nullptr;
}

int give_value(const GridCall& call, const Value& value, void* result, int length, RxInfoType_t* type,
               int* count) {
  StringPool& strings = call.run.state.machine.strings();
  std::vector<const char*> texts;
  for (const std::string& s : value.strings)
    texts.push_back(strings.text(strings.intern(s)).data());
  std::vector<int> integers;
  static_assert(sizeof(int) == sizeof(float));
  if (value.integers)
    for (float number : value.numbers)
      integers.push_back(static_cast<int>(number));
  const bool is_text = value.type == Type::kString;
  const size_t bytes = is_text ? texts.size() * sizeof(const char*) : value.numbers.size() * sizeof(float);
  const void* from = is_text          ? static_cast<const void*>(texts.data())
                     : value.integers ? static_cast<const void*>(integers.data())
                                      : value.numbers.data();
  if (length < 0 || bytes > static_cast<size_t>(length)) return static_cast<int>(bytes);
  if (bytes) std::memcpy(result, from, bytes);
  if (type) *type = info_type(value);
  if (count) *count = static_cast<int>(value.count());
  return 0;
}

const AnemonePluginServices& plugin_services() {
  static constexpr AnemonePluginServices kServices{ANEMONE_PLUGIN_SERVICES,
                                                   noise,
                                                   matrix,
                                                   query,
                                                   context_of_call,
                                                   plugin_lookup,
                                                   plugin_texture_info,
                                                   place,
                                                   plugin_cloud_point,
                                                   plugin_texels,
                                                   missing};
  return kServices;
}

} // namespace slvm

// Functions for shaders that are called once for all points of a grid, in C++ ("RSL plug-ins"). A source
// includes this, is compiled to a shared library and put into a folder that --dso or ANEMONE_DSO_PATH names.
// docs/plugins.md tells more.
//
//   static int sqr(RslContext*, int argc, const RslArg* argv[]) {
//     RslFloatIter result(argv[0]), x(argv[1]);
//     for (int i = 0, n = RslArg::NumValues(argc, argv); i < n; ++i, ++result, ++x) *result = *x * *x;
//     return 0;
//   }
//   static RslFunction functions[] = {{"float sqr(float)", sqr, NULL, NULL}, {NULL}};
//   RSLEXPORT RslFunctionTable RslPublicFunctions(functions);
//
// Prototypes: "[uniform|varying] result name([uniform] [output] type [[n]] [name], ...)". Entries of one name
// are overloads. argv[0] is the result (something unused when that is void), argv[1] and so on are the
// arguments. A function may be called by several threads at once, and returns 0 when all went well.
#pragma once

#include "RixInterfaces.h"
#include "ri.h"

#include <assert.h>
#include <stddef.h>

#define RSL_PLUGIN_VERSION 6
/// Of the binary interface between this header and the programs that open plug-ins.
#define ANEMONE_RSLPLUGIN_INTERFACE 2

#define RSLEXPORT __attribute__((visibility("default")))
#ifndef PRMANEXPORT
#define PRMANEXPORT RSLEXPORT
#endif

typedef unsigned int RslRunFlag;
/// Points from one active point to the next.
typedef unsigned int RslIncrType;

/// The call: the grid it is on, and services.
class RslContext : public RixContext {
public:
  /// 1 for each point of the grid that is active, else 0; `length` becomes the number of points. For
  /// RslArg::GetData.
  virtual const RslRunFlag* GetRunFlags(unsigned int* length) const = 0;
  virtual const char* GetPluginName() const = 0;

  RixStorage* GetGlobalStorage() const { return static_cast<RixStorage*>(GetRixInterface(k_RixGlobalData)); }
  RixStorage* GetThreadStorage() const { return static_cast<RixStorage*>(GetRixInterface(k_RixThreadData)); }
  RixStorage* GetLocalStorage() const { return static_cast<RixStorage*>(GetRixInterface(k_RixLocalData)); }
  /// One pointer of this plug-in in the storage of the thread, and of the grid.
  void SetThreadData(void* data, RixCleanupFunc cleanup = NULL) {
    GetThreadStorage()->Set(GetPluginName(), data, cleanup);
  }
  void* GetThreadData() const { return GetThreadStorage()->Get(GetPluginName()); }
  void SetLocalData(void* data, RixCleanupFunc cleanup = NULL) {
    GetLocalStorage()->Set(GetPluginName(), data, cleanup);
  }
  void* GetLocalData() const { return GetLocalStorage()->Get(GetPluginName()); }
  const char* GetToken(const char* text) const {
    return static_cast<RixTokenStorage*>(GetRixInterface(k_RixGlobalTokenData))->GetToken(text);
  }

private:
  template <typename T> friend class RslIter;
  template <typename T> friend class RslArrayIter;
  virtual const RslIncrType* steps() const = 0;
};

/// Sets the length of an array that has any: at most what the shader's variable holds.
class RslResizer {
public:
  virtual ~RslResizer() {}
  virtual void Resize(int length) = 0;
};

/// An argument.
class RslArg {
public:
  virtual ~RslArg() {}
  virtual bool IsFloat() const = 0;
  virtual bool IsPoint() const = 0;
  virtual bool IsVector() const = 0;
  virtual bool IsNormal() const = 0;
  virtual bool IsColor() const = 0;
  virtual bool IsMatrix() const = 0;
  virtual bool IsString() const = 0;
  virtual bool IsArray() const = 0;
  bool IsStruct() const { return false; }
  virtual bool IsVarying() const = 0;
  virtual bool IsWriteable() const = 0;
  /// An output array whose prototype gives no length.
  virtual bool IsResizable() const = 0;
  virtual RslResizer* GetResizer() const = 0;
  /// Of the argument; 0: not an array.
  virtual int GetArrayLength() const = 0;
  /// Active points, or 1 when the argument is uniform.
  virtual unsigned int NumValues() const = 0;
  /// The greatest of all arguments: how often to go round.
  static unsigned int NumValues(int argc, const RslArg* const* argv) {
    unsigned int most = 1;
    for (int i = 0; i < argc; ++i)
      if (argv[i]->NumValues() > most) most = argv[i]->NumValues();
    return most;
  }
  /// The values of all points of the grid, those that are not active too (which mean nothing); `stride`:
  /// floats from one point to the next, 0 when uniform. Of strings these are char*, 8 bytes or two floats
  /// each.
  virtual void GetData(float** data, int* stride) const = 0;
  /// Of the parameter, as the prototype has it.
  virtual const char* GetName() const = 0;

private:
  template <typename T> friend class RslIter;
  template <typename T> friend class RslArrayIter;
  /// The value of the first active point, floats from point to point, and the steps from one active point to
  /// the next.
  virtual void iterate(float** data, int* stride, const RslIncrType** steps) const = 0;
};

/// Goes over the values of an argument at active points; over a uniform one without moving.
template <typename T> class RslIter {
public:
  RslIter(const RslArg* arg) : varying_(arg->IsVarying()) { arg->iterate(&data_, &stride_, &steps_); }
  /// A value of one's own, as if it were a uniform argument.
  RslIter(const T* data, const RslContext* context)
      : data_(reinterpret_cast<float*>(const_cast<T*>(data))), stride_(0), steps_(context->steps()),
        varying_(false) {}

  T& operator*() { return *reinterpret_cast<T*>(data_); }
  const T& operator*() const { return *reinterpret_cast<const T*>(data_); }
  RslIter& operator++() {
    if (stride_) data_ += static_cast<size_t>(stride_) * *steps_++;
    return *this;
  }
  RslIter operator++(int) {
    RslIter before = *this;
    ++*this;
    return before;
  }
  bool IsVarying() const { return varying_; }

private:
  float* data_;
  int stride_;
  const RslIncrType* steps_;
  bool varying_;
};

/// The same for arrays: *it is the array at a point, it[k] an element.
template <typename T> class RslArrayIter {
public:
  RslArrayIter(const RslArg* arg) : length_(arg->GetArrayLength()), varying_(arg->IsVarying()) {
    arg->iterate(&data_, &stride_, &steps_);
  }
  RslArrayIter(const T* data, int length, const RslContext* context)
      : data_(reinterpret_cast<float*>(const_cast<T*>(data))), stride_(0), steps_(context->steps()),
        length_(length), varying_(false) {}

  T* operator*() { return reinterpret_cast<T*>(data_); }
  T& operator[](int k) { return reinterpret_cast<T*>(data_)[k]; }
  RslArrayIter& operator++() {
    if (stride_) data_ += static_cast<size_t>(stride_) * *steps_++;
    return *this;
  }
  RslArrayIter operator++(int) {
    RslArrayIter before = *this;
    ++*this;
    return before;
  }
  bool IsVarying() const { return varying_; }
  int GetLength() const { return length_; }

private:
  float* data_;
  int stride_;
  const RslIncrType* steps_;
  int length_;
  bool varying_;
};

typedef RslIter<RtFloat> RslFloatIter;
typedef RslIter<RtString> RslStringIter;
typedef RslIter<RtColor> RslColorIter;
typedef RslIter<RtPoint> RslPointIter;
typedef RslIter<RtVector> RslVectorIter;
typedef RslIter<RtNormal> RslNormalIter;
typedef RslIter<RtMatrix> RslMatrixIter;
typedef RslArrayIter<RtFloat> RslFloatArrayIter;
typedef RslArrayIter<RtString> RslStringArrayIter;
typedef RslArrayIter<RtColor> RslColorArrayIter;
typedef RslArrayIter<RtPoint> RslPointArrayIter;
typedef RslArrayIter<RtVector> RslVectorArrayIter;
typedef RslArrayIter<RtNormal> RslNormalArrayIter;
typedef RslArrayIter<RtMatrix> RslMatrixArrayIter;

typedef int (*RslEntryFunc)(RslContext* context, int argc, const RslArg* argv[]);
typedef void (*RslVoidFunc)(RixContext* context);

/// `init` and `cleanup` are called once in each frame, before the function's first and after its last call;
/// `begin` and `end` likewise, before and after those.
struct RslFunction {
  const char* prototype;
  RslEntryFunc entry;
  RslVoidFunc init;
  RslVoidFunc cleanup;
  RslVoidFunc begin;
  RslVoidFunc end;
};

/// The library's table, always called RslPublicFunctions. `init` and `cleanup`: before the first and after
/// the last function of the library in a frame.
struct RslFunctionTable {
  const RslFunction* functions;
  RslVoidFunc init;
  RslVoidFunc cleanup;
  RslFunctionTable(const RslFunction* list, RslVoidFunc init_library = NULL,
                   RslVoidFunc cleanup_library = NULL)
      : functions(list), init(init_library), cleanup(cleanup_library) {}
};

extern "C" {
/// Tells the programs that open the plug-in what it was compiled with.
extern __attribute__((weak, visibility("default"))) const int anemone_rslplugin_interface;
const int anemone_rslplugin_interface = ANEMONE_RSLPLUGIN_INTERFACE;
}

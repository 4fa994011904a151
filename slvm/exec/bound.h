// What instantiate() prepares so that runs start at once: constants and parameter values as planes, functions
// of the program's imports, and where predefined variables are among its slots.
#pragma once

#include "slvm/exec/grid_ops.h"
#include "slvm/machine.h"
#include "slvm/wide/operand.h"

#include <new>

namespace slvm {

struct HostedFunction; // slvm/exec/plugin_host.h

/// Memory for planes: aligned, not initialised, grows only.
class PlaneMemory {
public:
  /// At least this many floats; contents are lost when it grows.
  float* reserve(size_t floats) {
    if (floats > size_) {
      data_.reset(
          static_cast<float*>(::operator new[](floats * sizeof(float), std::align_val_t{kPlaneAlign})));
      size_ = floats;
    }
    return data_.get();
  }
  float* data() const { return data_.get(); }

private:
  struct Free {
    void operator()(float* p) const { ::operator delete[](p, std::align_val_t{kPlaneAlign}); }
  };
  std::unique_ptr<float, Free> data_;
  size_t size_ = 0;
};

struct Instance::Bound {
  PlaneMemory constants; ///< kMaxLanes floats a plane
  PlaneMemory params;    ///< values of parameters that have one
  std::vector<Planes>
      param_planes; ///< by slot; data null: no value here (a predefined variable, or computed by init)
  /// Defaults to compute at the begin of each run: code section, and slot of the parameter.
  std::vector<std::pair<uint32_t, uint32_t>> defaults;
  struct Import {
    Kernel kernel = nullptr;
    GridOp grid_op = nullptr;
    HostedFunction* plugin = nullptr; ///< a function of a plug-in; the machine's
  };
  std::vector<Import> imports;
  std::vector<Global> globals;   ///< by slot; kCount for parameters
  int32_t slot_of[kGlobalCount]; ///< by predefined variable; -1: not used by the program
  size_t most_operands = 0;      ///< words of the longest call
  /// Words of code in strip blocks that are operands: those that are in the same place for every strip of a
  /// grid, and those that move from strip to strip. Both in order.
  std::vector<uint32_t> fixed_operands, moving_operands;
  /// What the instance was made with, of shaders that may be made again otherwise: lights and surfaces.
  std::vector<ParamValue> given;
  std::vector<std::string> may_vary;
  /// What the shader's code from this word on stores at neighbouring points nobody reads: derivatives behind
  /// it are of what was computed before.
  uint32_t neighbours_end = 0;
  bool emits = false;          ///< a light with illuminate or solar: not an ambient light
  bool emits_once = false;     ///< one such block, outside loops: its L, Cl and Ol stay where they are
  bool reads_messages = false; ///< its results depend on other shaders' parameters
};

} // namespace slvm

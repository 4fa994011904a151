// Watching shaders run, instruction by instruction: profilers, debuggers, coverage. PUBLIC. A context without
// an observer runs a dispatch loop that has no trace of it.
//
//   struct Counter : slvm::ExecutionObserver {
//     void after(const slvm::ExecutionStep& step) override { points += step.active_points(); }
//     size_t points = 0;
//   } counter;
//   context.observe(&counter); // until observe(nullptr)
#pragma once

#include "slvm/machine.h"

#include <span>
#include <string_view>
#include <vector>

namespace slvm {

class MaskStack;
class ShaderRun;
struct Frame;

/// A place in the source of a shader; line 0: nowhere.
struct SourcePlace {
  std::string_view file;
  uint32_t line = 0, column = 0;
};

/// The place a word of a program's code comes from.
SourcePlace place_of(const Program&, uint32_t code);

/// An operand of a call. Varying planes begin at the step's first point.
struct StepOperand {
  Planes planes;
  bool stored = false;
  std::string_view variable; ///< the external variable it is, or ""
};

/// One instruction on some points of a grid: all of them, or those of a strip. Valid during the callback
/// only.
class ExecutionStep {
public:
  ExecutionStep(const ShaderRun& run, const Frame& frame, const MaskStack& mask, uint32_t code)
      : run_(run), frame_(frame), mask_(mask), code_(code) {}

  /// The shader. Lights run inside the run of what they light.
  const Instance& instance() const;
  const Program& program() const;
  /// Word of the program's code where the instruction begins.
  uint32_t code() const { return code_; }
  SourcePlace place() const { return place_of(program(), code_); }
  /// The function that is called, or null: one of the instructions of opcodes.def.
  const ShadeopInfo* call() const;
  /// Operands of a call, those it stores first. Of the load of an array element what it stores, as a float
  /// array of its components, and the array. None of other instructions.
  std::vector<StepOperand> operands() const;

  /// Points [first_point(), first_point() + points()) are looked at; those that are active have a bit in
  /// mask().
  size_t first_point() const;
  size_t points() const;
  std::span<const uint64_t> mask() const;
  size_t active_points() const;
  const Grid& grid() const;
  const StringPool& strings() const;

private:
  StepOperand operand_of(uint32_t word) const;

  const ShaderRun& run_;
  const Frame& frame_;
  const MaskStack& mask_;
  uint32_t code_;
};

class ExecutionObserver {
public:
  virtual ~ExecutionObserver() = default;
  /// Before each instruction. False leaves it out; only calls without results may be.
  virtual bool before(const ExecutionStep&) { return true; }
  /// After each call of a function, and each load of an array element. Of what it stored only active points
  /// count.
  virtual void after(const ExecutionStep&) {}
  /// A shader begins, or has come to its end; in between others may, when lights run.
  virtual void begin_run(const Instance&) {}
  virtual void end_run(const Instance&) {}
};

} // namespace slvm

// Calls that ask for something by name and store it in a variable: messages, attributes, options, facts. The
// result is 1 where it is found with the variable's type; else 0, and the variable keeps its value.
#pragma once

#include "slvm/exec/grid_ops.h"
#include "slvm/exec/run.h"

namespace slvm {

struct Query {
  /// Operands: result, value stored, what is read up to the name at `name_operand`, value before. An array is
  /// stored and read in place.
  explicit Query(const GridCall& call, size_t name_operand = 2);

  /// Of the variable.
  size_t planes() const {
    return static_cast<size_t>(components(out.type)) * (out.array ? out.planes.elements : 1);
  }
  uint32_t elements() const { return out.array ? out.planes.elements : 0; }
  void result(bool yes) const { std::fill_n(found.data, kMaxLanes, yes ? 1.0f : 0.0f); }

  void not_found() const;
  /// Not found, with a message: the thing has this type, the variable another.
  void wrong_type(Type type, uint32_t elements = 0) const;
  /// Found: these planes, or this value if it is of the variable's type.
  void give(const Operand& from) const;
  void give(const Value& value) const;

  const GridCall& call;
  ShaderRun& run;
  Operand found;
  GridOperand out, before;
  std::string_view name;

private:
  void copy(const Operand& from) const;
};

} // namespace slvm

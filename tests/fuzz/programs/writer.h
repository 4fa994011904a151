// The state of one program being written: what is in scope, and how deep and how long it may still get.
#pragma once

#include "slvm/format/shadeop_info.h"
#include "tests/fuzz/programs/choices.h"

#include <string>
#include <vector>

namespace slvm::test {

/// What may be named at some place in the program.
struct Variable {
  std::string name;
  Type type = Type::kFloat;
  int elements = 0; ///< 0: not an array
  bool uniform = false;
  bool assignable = true;
  bool input = false; ///< the same at all places
};

struct Function {
  std::string name;
  Type result = Type::kVoid;
  std::vector<Variable> formals; ///< assignable: an output
};

class ProgramWriter {
public:
  explicit ProgramWriter(Choices& choices) : choose_(choices) {}

  std::string program(bool pointwise);
  std::string light(bool pointwise);

private:
  // ---- expressions.cpp: each gives text that can stand anywhere
  std::string expression(Type, int depth, bool uniform);
  std::string condition(int depth, bool uniform);
  std::string literal(Type);
  std::string text_literal(std::string_view purpose);
  std::string leaf(Type, bool uniform);
  std::string call(ShadeopId, int depth, bool uniform);
  std::string call(const Function&, int depth);
  bool arguments(ShadeopId, int depth, bool uniform, std::vector<std::string>& out);
  std::string element(const Variable&, int depth);
  std::string cast(Type, const std::string& text) const;
  /// Rows of the table that give this type, operators or functions; those that need no scene.
  std::vector<ShadeopId> rows(Type result, bool uniform) const;

  // ---- statements.cpp
  void block(int statements);
  void statement();
  void declaration();
  void assignment();
  void if_statement();
  void loop();
  void jump();
  void illuminance();
  void rays();
  std::string ray_outputs();
  std::string ray_function();
  void print();
  void nested_function();
  void call_statement();
  void function(const std::string& name);
  void line(const std::string& text);

  /// Variables of a type that can be read, or set, here.
  std::vector<const Variable*> variables(Type, bool uniform, bool set, bool arrays = false) const;
  template <class T> const T& one_of(const std::vector<T>& from) { return from[choose_.below(from.size())]; }
  Type some_type();
  /// Executing only in some points, by what is known here: no uniform variable may be set.
  bool divergent() const { return divergence_ > 0; }

  Choices& choose_;
  std::string out_;
  std::vector<Variable> scope_;
  std::vector<Function> functions_;
  int indent_ = 0, next_name_ = 0, nesting_ = 0, loops_ = 0, divergence_ = 0, without_jumps_ = 0;
  int statements_left_ = 40;
  Type returns_ = Type::kVoid;
  bool in_function_ = false, in_illuminance_ = false, in_light_ = false, pointwise_ = false;
  /// Writing what a derivative under a condition differentiates: functions of the inputs, which every
  /// neighbour has. How many neighbours have other values is the optimiser's affair.
  bool inputs_only_ = false;
};

} // namespace slvm::test

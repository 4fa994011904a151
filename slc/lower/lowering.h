// The state of lowering one shader. Read next: shader.cpp (begin and end), statements.cpp, expressions.cpp,
// calls.cpp.
//
// Every scalar variable in scope has a current value; assignment replaces it. Where control flow meets,
// values that differ become results of the region's instruction. A loop carries all variables in scope: which
// of them change is known only at its end, and the copies pass drops the others. Arrays are memory of their
// own.
#pragma once

#include "slc/ast/unit.h"
#include "slvm/ir/build.h"

#include <unordered_map>

namespace slc {

namespace ir = slvm::ir;

class Lowering {
public:
  Lowering(const Shader& shader, std::vector<std::string> files, std::vector<slvm::SourceCall>& calls);
  ir::Module run();

private:
  using ValueId = ir::ValueId;
  using Values = std::vector<ValueId>; ///< by variable index; kNoValue: not in scope

  // ---- shader.cpp
  void lower_params();
  void lower_body();
  void lower_init(const Variable& param, slvm::Param& out);
  const Expr* spaceless_default(const Variable& param) const;
  void begin_variables();
  void begin_copies();
  void store_changed(bool outputs_only);
  uint32_t slot_of(const std::string& name, Type type, uint32_t elements, bool parameter, bool varying);
  uint32_t global_slot(Global g);

  // ---- Variables (shader.cpp).
  size_t new_index(Type t);
  size_t index_of(const Variable& v);
  ValueId read(const Variable& v);
  void write(const Variable& v, ValueId value);
  void forget(size_t declared_from);
  uint32_t array_of(const Variable& v);
  ValueId zero(Type t);

  // ---- statements.cpp
  void statement(const Stmt& s);
  /// What is made from now on belongs to the beginning of the statement.
  void back_to(const Stmt& s);
  void block(const BlockStmt& s);
  void declaration(const Variable& v);
  void if_statement(const IfStmt& s);
  /// Either branch may be null.
  void two_sided(ValueId condition, const StmtPtr& then_branch, const StmtPtr& else_branch);
  void loop(const LoopStmt& s);
  void jump(const JumpStmt& s);
  void return_statement(const ReturnStmt& s);
  void illuminance(const IlluminanceStmt& s);
  bool begin_sending(const std::vector<TokenArg>& tokens);
  void receive_from_light(const std::vector<TokenArg>& tokens);
  void emission(const EmissionStmt& s);
  void gather(const GatherStmt& s);
  template <class Body> void rounds(const Stmt& s, ir::Op op, uint32_t index, Values args, Body&& make_body);
  /// What the call before the loop reads.
  Values gather_args(const GatherStmt& s);
  void receive_from_ray(const std::vector<TokenArg>& tokens);
  void initialise_array(const Variable& v);

  /// A loop, light loop or inlined function that code inside may leave.
  struct Frame {
    bool user_loop = false;           ///< counted by break n and continue n
    std::vector<size_t> carried;      ///< variables, by index
    const LoopStmt* source = nullptr; ///< for its steps
  };
  /// Variables in scope now: what a loop carries.
  std::vector<size_t> in_scope() const;
  Values values_for(const std::vector<size_t>& variables) const;
  std::vector<Type> types_of(const std::vector<size_t>& variables) const;
  void set_values(const std::vector<size_t>& variables, const Values& values);
  /// Region parameters for carried variables, which they become.
  void open_carried(ir::Region& region, const std::vector<size_t>& carried);
  void loop_steps(const LoopStmt& s);

  /// Lowers into a region of its own; the region of before is current again afterwards.
  template <class F> ir::Region region(F&& fill) {
    ir::Region out;
    ir::Region* outer = b_.region();
    b_.set_region(&out);
    fill();
    b_.set_region(outer);
    return out;
  }
  /// Two-way branch: lowers both sides, merges the variables they changed. Sides may give a value of type
  /// `type`.
  template <class Then, class Else>
  ValueId branch(ValueId condition, Type type, Then&& then_side, Else&& else_side);

  // ---- expressions.cpp
  ValueId value(const Expr& e);
  ValueId variable_value(const VariableExpr& e);
  ValueId logical(const LogicalExpr& e);
  ValueId conditional(const ConditionalExpr& e);
  ValueId assignment(const AssignExpr& e);
  void array_assignment(uint32_t array, const Expr& value);
  ValueId call_row(ShadeopId row, std::vector<ValueId> args);

  /// A variable, array element or component that something is stored to; its subscript is evaluated once.
  struct Place {
    const Variable* variable = nullptr;
    bool element = false;   ///< with a subscript
    bool component = false; ///< that of a color, point, vector or normal
    ValueId subscript = ir::kNoValue;
    bool whole_array = false;
  };
  Place place(const Expr& e);
  ValueId load(const Place& p);
  void store(const Place& p, ValueId value);

  // ---- calls.cpp
  ValueId call(const CallExpr& e);
  ValueId inline_function(const CallExpr& e);
  ValueId builtin_call(const CallExpr& e);
  void note_call(ShadeopId row);
  /// The row of a call, or the id of the plug-in's function among the module's.
  ShadeopId called(const CallExpr& e);
  /// A call whose result comes first and whose outputs go to these places; gives the result.
  ValueId call_into(ShadeopId, const Values& args, const std::vector<Type>& result_types,
                    const std::vector<Place>& places);
  ValueId next_count();
  void add_seed(Values& args);
  ValueId random_call(const CallExpr& e, const slvm::ShadeopInfo& info);
  /// The statements of a function or shader; `result`: variable index of what it returns, 0 for none.
  void function_body(const BlockStmt& body, size_t result);

  const Shader& shader_;
  ir::Module m_;
  ir::Builder b_;

  std::unordered_map<const Variable*, size_t> indices_;
  size_t global_index_[slvm::kGlobalCount] = {}; ///< of writable predefined variables; 0: not one
  std::vector<Type> variable_types_;             ///< by variable index
  Values values_;
  Values initial_; ///< by variable index: what a global or output parameter was when the shader began
  std::vector<std::pair<size_t, uint32_t>>
      stored_back_;         ///< variable index and slot: stored at the end when changed
  size_t outputs_from_ = 0; ///< stored_back_ from here on are output parameters
  /// Of functions being inlined, outermost first: a variable that was passed, and the output formal that
  /// stands for it.
  std::vector<std::pair<size_t, size_t>> lent_;
  std::unordered_map<const Variable*, uint32_t> arrays_;
  std::unordered_map<const Variable*, uint32_t> param_slots_;
  std::vector<size_t> declared_; ///< variable indices in order of declaration, to take them out of scope

  std::vector<Frame> frames_;
  struct Function {
    size_t result = 0;     ///< variable index of the result, 0 for none
    bool in_block = false; ///< return leaves a block: the frame of this index
    size_t frame = 0;
  };
  std::vector<Function> functions_;
  std::vector<slvm::SourceCall>& calls_;
  int library_depth_ = 0;        ///< RSL bodies of built-ins around this point
  std::vector<ValueId> targets_; ///< old values of compound assignments being evaluated
  size_t random_counter_ = 0;    ///< variable index of the hidden counter behind random() and rays
  bool uniform_wanted_ =
      false; ///< inside the value of a variable declared uniform: random() is uniform there
};

template <class Then, class Else>
slvm::ir::ValueId Lowering::branch(ValueId condition, Type type, Then&& then_side, Else&& else_side) {
  const SourceRange here = b_.where;
  Values before = values_;
  ValueId results[2] = {ir::kNoValue, ir::kNoValue};
  Values after[2];
  bool ends[2];
  ir::Region regions[2];
  for (int side = 0; side < 2; ++side) {
    values_ = before;
    regions[side] = region([&] {
      results[side] = side == 0 ? then_side() : else_side();
      ends[side] = b_.terminated();
    });
    values_.resize(std::max(values_.size(), before.size()), ir::kNoValue);
    after[side] = values_;
  }
  std::vector<size_t> changed;
  for (size_t i = 0; i < before.size(); ++i)
    if (before[i] != ir::kNoValue &&
        ((!ends[0] && after[0][i] != before[i]) || (!ends[1] && after[1][i] != before[i])))
      changed.push_back(i);
  bool has_value = type != Type::kVoid;
  for (int side = 0; side < 2; ++side) {
    if (ends[side]) continue;
    Values out;
    if (has_value) out.push_back(results[side]);
    for (size_t i : changed)
      out.push_back(after[side][i]);
    ir::Region* outer = b_.region();
    b_.set_region(&regions[side]);
    b_.yield(std::move(out));
    b_.set_region(outer);
  }
  std::vector<Type> types;
  if (has_value) types.push_back(type);
  for (size_t i : changed)
    types.push_back(variable_types_[i]);
  std::vector<ir::Region> list;
  list.push_back(std::move(regions[0]));
  list.push_back(std::move(regions[1]));
  b_.where = here;
  ir::InstId id = b_.region_inst(ir::Op::kIf, 0, {condition}, std::move(list), types);
  values_ = before;
  values_.resize(variable_types_.size(), ir::kNoValue);
  for (size_t i = 0; i < changed.size(); ++i)
    values_[changed[i]] = m_.insts[id].results[i + has_value];
  return has_value ? m_.insts[id].results[0] : ir::kNoValue;
}

} // namespace slc

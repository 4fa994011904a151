// The walk over one shader with its calls expanded that contexts.h is about: which values vary, by a
// fixpoint. What varies stays so; the walk is repeated until nothing changes, and once more to report. Its
// parts: contexts.cpp (beginning, answers), context_statements.cpp, context_values.cpp, context_places.cpp.
//
// Control that some lanes have left counts as varying. There are two degrees: under a varying condition or in
// gather (hard), and in light loops or after a varying break or return (soft). A variable set there varies
// from then on, as it does in the IR; for a declared uniform that is worth a warning where the control is
// hard.
#pragma once

#include "slc/ast/unit.h"
#include "slc/diag/messages.h"
#include "slc/sema/reasons.h"

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

namespace slc {

// How much a value varies, as bits to be or-ed. kSomewhere: only because a declared uniform was set at some
// points and not at others; what is declared uniform may take that, and varies likewise. kVarying: by itself.
enum Degree : unsigned { kUniform = 0, kSomewhere = 1, kVarying = 3 };

// How much a value varies, and the first thing that makes it.
struct Variation {
  unsigned degree = kUniform;
  Reason why;

  explicit operator bool() const { return degree != kUniform; }
  Variation& operator|=(const Variation& more) {
    if (degree < more.degree) why = more.why;
    degree |= more.degree;
    return *this;
  }
  friend Variation operator|(Variation a, const Variation& b) { return a |= b; }
};

// A variable in one expansion of the function it belongs to.
struct VarState {
  const Variable* declared = nullptr;
  unsigned variation = kUniform;
  const Cause* cause = nullptr; // once it varies
  int hard = 0, soft = 0;       // control around the declaration
};

// An output formal: another name of the variable it is called with.
struct Alias {
  const VarState* state = nullptr;
  std::string_view actual;
  SourceRange where; // in the call
};

// One expansion of a function, or the shader itself. Kept between rounds.
struct Instance {
  std::map<const Variable*, VarState> variables;
  std::map<const CallExpr*, std::unique_ptr<Instance>> calls;
  std::map<const Variable*, Alias> aliases;
  std::map<const Stmt*, const Cause*> soft_loops; // loops some lanes leave earlier than others
  const Cause* soft_rest = nullptr;               // some lanes have returned already
  std::map<const void*, const Cause*> controls;   // by statement or condition: why lanes part there
  unsigned result = kUniform;
  const Cause* result_cause = nullptr;
};

// What was reported where: one function may be expanded in many places.
using Reported = std::set<std::tuple<slvm::FileId, uint32_t, uint32_t, Msg>>;

inline bool declared_uniform(const Variable& v) {
  return v.detail_given && v.detail == Detail::kUniform;
}
inline bool always_uniform(const Variable& v) {
  return declared_uniform(v) || (v.kind == VariableKind::kParameter && !v.detail_given && !v.copied);
}

class ContextWalk {
public:
  ContextWalk(Shader& shader, slvm::Diagnostics& diags, Reported& reported)
      : shader_(shader), diags_(diags), reported_(reported) {}

  void run() {
    do {
      changed_ = false;
      walk_shader();
    } while (changed_ && !gave_up_);
    reporting_ = true;
    if (!gave_up_) walk_shader();
  }

  /// After run(): what is known of the variables of this name, each answer once, in source order.
  std::vector<std::vector<slvm::Note>> explain(std::string_view name) const;

private:
  struct Loop {
    const Stmt* statement;
    int control; // around it
  };
  // What holds at one point of the walk within one instance.
  struct Frame {
    Instance* instance = nullptr;
    const FunctionDef* function = nullptr;
    int control = 0; // around the call: inside, all lanes of the caller are there
    std::vector<Loop> loops;
  };

  void walk_shader();
  void statement(Stmt* s);
  void declare(Variable& v);
  void loop(LoopStmt& s);
  void jump(const JumpStmt& s);
  void leave(ReturnStmt& s);
  void illuminance(IlluminanceStmt& s);
  void emission(EmissionStmt& s);
  void gather(GatherStmt& s);
  void need_uniform(Expr* e, std::string_view name, std::string_view callee);
  void loop_body(const Stmt& loop, Stmt* body);

  Variation value(Expr* e);
  Variation value_here(Expr& e);
  Variation values(std::vector<ExprPtr>& list);
  Variation call(CallExpr& e);
  Variation inlined(CallExpr& e);
  Variation row_call(CallExpr& e);
  Variation tokens(std::vector<TokenArg>& list, const Variation& output);
  Variation assign(AssignExpr& e);
  Variation read(const Variable* v, SourceRange where);
  void store(Expr& place, Variation variation, SourceRange where);
  void store_variable(VarState& state, const Variation& variation, SourceRange where, std::string_view name);
  Variation value_for(Expr* e, bool once);

  VarState& state(const Variable& v);
  /// Makes something vary as much as `more`, too; the first cause stays.
  void mark(unsigned& degree, const Cause*& cause, unsigned more, const Cause& why) {
    if (more && !cause) cause = &causes_.emplace_back(why);
    changed_ |= std::exchange(degree, degree | more) != degree;
  }
  void mark(const Cause*& flag, const Cause* why) {
    changed_ |= !flag;
    if (!flag) flag = why;
  }
  /// Control that some lanes only are under, as long as the object lives; none without cause.
  class Around {
  public:
    Around(ContextWalk& walk, int& counter, const Cause* cause) : walk_(walk), counter_(counter) {
      if (!cause) return;
      entered_ = true;
      ++counter_;
      walk_.controls_.push_back(cause);
    }
    ~Around() {
      if (!entered_) return;
      --counter_;
      walk_.controls_.pop_back();
    }
    Around(const Around&) = delete;
    Around& operator=(const Around&) = delete;

  private:
    ContextWalk& walk_;
    int& counter_;
    bool entered_ = false;
  };
  /// Why lanes part at a statement or condition of this instance: one cause, however often it is walked.
  const Cause* control_at(const void* node, const Cause& why) {
    const Cause*& known = here().controls[node];
    if (!known) known = &causes_.emplace_back(why);
    return known;
  }
  const Cause* condition(const Expr* e, const Variation& v) {
    return v ? control_at(e, {Cause::kCondition, e->range, "", v.why, nullptr}) : nullptr;
  }
  const Cause* around(const Stmt& s, Cause::Kind kind) {
    return control_at(&s, {kind, s.range, "", {}, nullptr});
  }
  /// The outermost varying control inside of what there is `outside` of.
  const Cause* control_from(int outside) const { return controls_[static_cast<size_t>(outside)]; }
  const Cause* early(const Stmt& loop) {
    auto it = here().soft_loops.find(&loop);
    return it == here().soft_loops.end() ? nullptr : it->second;
  }
  void explain(const Instance& instance, std::string_view name,
               std::vector<std::vector<slvm::Note>>& answers) const;
  int control() const { return hard_ + soft_; }
  Instance& here() { return *frame_.instance; }
  void check_global(const Variable& v, bool store, SourceRange where);
  void check_row_place(const CallExpr& e, uint32_t flags);
  template <class... Args> void complain(Msg id, SourceRange where, const Args&... args) {
    complain_of(Reason(), id, where, args...);
  }
  /// With the nearest step to what makes the value vary as a note.
  template <class... Args>
  void complain_of(const Reason& why, Msg id, SourceRange where, const Args&... args) {
    if (!reporting_ || !reported_.insert({where.file, where.line, where.column, id}).second) return;
    slvm::Diagnostic& d = report(diags_, id, where, args...);
    d.notes = nearest_step(why);
  }

  Shader& shader_;
  slvm::Diagnostics& diags_;
  Reported& reported_;
  Instance root_;
  Frame frame_;
  std::map<const Variable*, VarState*> bound_;  // variables of the expansions around this point
  std::set<const FunctionDef*> open_functions_; // being expanded
  size_t expansions_ = 0;
  int hard_ = 0, soft_ = 0;
  std::deque<Cause> causes_;           // all there are
  std::vector<const Cause*> controls_; // hard_ + soft_ of them, outermost first
  int illuminance_ = 0, emission_ = 0; // loops around this point, callers' included
  Variation old_value_;                // of the target of a compound assignment
  bool changed_ = false, reporting_ = false, gave_up_ = false;
  bool drawing_once_ = false; // random() is uniform here
};

} // namespace slc

#include "slc/sema/reasons.h"

#include <fmt/format.h>

namespace slc {
namespace {

class Teller {
public:
  std::vector<slvm::Note> take() { return std::move(notes_); }

  void tell(const Cause& c) {
    switch (c.kind) {
    case Cause::kDeclared: add(c.where, fmt::format("'{}' is varying: it is declared so", c.name)); break;
    case Cause::kSet:
      add(c.where, fmt::format("'{}' is varying: it is set from {} here", c.name, thing(c.reason)));
      break;
    case Cause::kSetUnder:
      add(c.where, fmt::format("'{}' is varying: it is set {}", c.name, under(c.control)));
      break;
    case Cause::kGiven:
      add(c.where, fmt::format("'{}' is varying: it is given {} here", c.name, thing(c.reason)));
      break;
    case Cause::kReturned:
      add(c.where,
          fmt::format("'{}' returns a varying value: it depends on {} here", c.name, thing(c.reason)));
      break;
    case Cause::kReturnedUnder:
      add(c.where, fmt::format("'{}' returns a varying value: it returns {}", c.name, under(c.control)));
      break;
    case Cause::kCondition:
      add(c.where, fmt::format("the condition is varying: it depends on {}", thing(c.reason)));
      break;
    case Cause::kLights: add(c.where, "light reaches some points and not others"); break;
    case Cause::kRays: add(c.where, "rays are shot from each point"); break;
    case Cause::kLoopLeft:
      add(c.where, fmt::format("some points leave the round here, {}", under(c.control)));
      break;
    case Cause::kReturnedFrom:
      add(c.where, fmt::format("some points return here, {}", under(c.control)));
      break;
    }
    tell(c.reason);
    if (c.control) tell(*c.control);
  }

  void tell(const Reason& r) {
    if (r.kind == Reason::kGlobal)
      add(r.where, fmt::format("'{}' is a predefined variable that varies", r.name));
    if (r.kind == Reason::kBuiltin)
      add(r.where, fmt::format("what '{}' gives varies, whatever it is given", r.name));
    if (r.cause) tell(*r.cause);
  }

private:
  void add(const slvm::SourceRange& where, std::string text) { notes_.push_back({where, std::move(text)}); }

  static std::string thing(const Reason& r) {
    switch (r.kind) {
    case Reason::kNone: return "something varying";
    case Reason::kFunction: return fmt::format("what '{}' returns", r.name);
    default: return fmt::format("'{}'", r.name);
    }
  }

  static std::string_view under(const CausePtr& control) {
    switch (control ? control->kind : Cause::kDeclared) {
    case Cause::kCondition: return "under a varying condition here";
    case Cause::kLights: return "in a light loop here";
    case Cause::kRays: return "in a loop over rays here";
    case Cause::kLoopLeft: return "here, in a loop that some points leave earlier";
    case Cause::kReturnedFrom: return "here, where some points have returned already";
    default: return "at some points only here";
    }
  }

  std::vector<slvm::Note> notes_;
};

} // namespace

std::vector<slvm::Note> steps(const Cause& cause) {
  Teller teller;
  teller.tell(cause);
  return teller.take();
}

std::vector<slvm::Note> steps(const Reason& reason) {
  Teller teller;
  teller.tell(reason);
  return teller.take();
}

} // namespace slc

#include "slc/sema/reasons.h"

#include <fmt/format.h>

namespace slc {
namespace {

std::string thing(const Reason& r) {
  switch (r.kind) {
  case Reason::kNone: return "something varying";
  case Reason::kFunction: return fmt::format("what '{}' returns", r.name);
  default: return fmt::format("'{}'", r.name);
  }
}

std::string_view under(const Cause* control) {
  switch (control ? control->kind : Cause::kDeclared) {
  case Cause::kCondition: return "under a varying condition here";
  case Cause::kLights: return "in a light loop here";
  case Cause::kRays: return "in a loop over rays here";
  case Cause::kLoopLeft: return "here, in a loop that some points leave earlier";
  case Cause::kReturnedFrom: return "here, where some points have returned already";
  default: return "at some points only here";
  }
}

std::string text_of(const Cause& c) {
  switch (c.kind) {
  case Cause::kDeclared: return fmt::format("'{}' is varying: it is declared so", c.name);
  case Cause::kSet: return fmt::format("'{}' is varying: it is set from {} here", c.name, thing(c.reason));
  case Cause::kSetUnder: return fmt::format("'{}' is varying: it is set {}", c.name, under(c.control));
  case Cause::kGiven: return fmt::format("'{}' is varying: it is given {} here", c.name, thing(c.reason));
  case Cause::kReturned:
    return fmt::format("'{}' returns a varying value: it depends on {} here", c.name, thing(c.reason));
  case Cause::kReturnedUnder:
    return fmt::format("'{}' returns a varying value: it returns {}", c.name, under(c.control));
  case Cause::kCondition: return fmt::format("the condition is varying: it depends on {}", thing(c.reason));
  case Cause::kLights: return "light reaches some points and not others";
  case Cause::kRays: return "rays are shot from each point";
  case Cause::kLoopLeft: return fmt::format("some points leave the round here, {}", under(c.control));
  case Cause::kReturnedFrom: return fmt::format("some points return here, {}", under(c.control));
  }
  return "";
}

// What varies by itself ends a chain.
void add_end(const Reason& r, std::vector<slvm::Note>& notes) {
  if (r.kind == Reason::kGlobal)
    notes.push_back({r.where, fmt::format("'{}' is a predefined variable that varies", r.name)});
  if (r.kind == Reason::kBuiltin)
    notes.push_back({r.where, fmt::format("what '{}' gives varies, whatever it is given", r.name)});
}

} // namespace

std::vector<slvm::Note> steps(const Cause& cause) {
  std::vector<slvm::Note> notes;
  for (const Cause* c = &cause; c; c = c->control ? c->control : c->reason.cause) {
    notes.push_back({c->where, text_of(*c)});
    add_end(c->reason, notes);
  }
  return notes;
}

std::vector<slvm::Note> nearest_step(const Reason& reason) {
  std::vector<slvm::Note> notes;
  if (reason.cause) notes.push_back({reason.cause->where, text_of(*reason.cause)});
  add_end(reason, notes);
  return notes;
}

} // namespace slc

// Solid blocks: they grow the tree of their solid, whose primitives are told by the state of surfaces
// (RISpec 3.2, 5.9).
#include "render/state/interpreter.h"

#include <fmt/format.h>

namespace render {

void Interpreter::solid_begin(const RequestCall& call) {
  constexpr std::pair<std::string_view, SolidOperation> kNames[] = {
      {"primitive", SolidOperation::kPrimitive},
      {"union", SolidOperation::kUnion},
      {"intersection", SolidOperation::kIntersection},
      {"difference", SolidOperation::kDifference}};
  open(call, BlockKind::kSolid);
  std::optional<SolidOperation> operation;
  for (auto [name, value] : kNames)
    if (name == call.text(0)) operation = value;
  if (!operation) {
    error_at(
        call.arguments[0].where, call,
        fmt::format("unknown operation \"{}\"; known are primitive, union, intersection, difference; the "
                    "block is read as a union",
                    call.text(0)));
    operation = SolidOperation::kUnion;
  }
  if (solid_.in_primitive()) {
    error(call, "a \"primitive\" is made of surfaces, not of solids; those in this block become part of it");
    return;
  }
  if (!solid_.tree)
    solid_ = {std::make_shared<SolidTree>(++scene_.solids, *operation)};
  else
    solid_.node = solid_.tree->add(*operation, solid_.node);
}

void Interpreter::solid_end(const RequestCall& call) {
  SolidPlace closed = solid_;
  if (close(call, BlockKind::kSolid) && closed.in_operation() && (*closed.tree)[closed.node].operands == 0)
    warn(call, "the operation has no solids to work on");
}

/// A surface between the solids of an operation becomes a solid of its own.
void Interpreter::call_in_operation(const RequestCall& call) {
  SolidPlace operation = solid_;
  // The later calls of a motion block make shapes of the first one's surfaces.
  if (!in_motion_ || in_motion_->calls == 1) {
    solid_.node = solid_.tree->add(SolidOperation::kPrimitive, solid_.node);
    warn(call, "surfaces in an operation on solids belong in SolidBegin \"primitive\"; this one is read as "
               "a solid by itself");
  }
  (this->*handler(call.id))(call);
  solid_ = operation;
}

} // namespace render

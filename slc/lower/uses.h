// What compiled code asks of the outside, with the places in the source: read off the IR, be it fresh from
// the optimiser or out of a .slo file.
#pragma once

#include "slc/ast/expr.h"
#include "slvm/ir/ir.h"

#include <string>
#include <vector>

namespace slc {

/// What says which thing is meant: texture("wood.tex"), texture(map), texture(concat(...)).
struct Naming {
  enum Kind : uint8_t { kNone, kConstant, kParameter, kComputed } kind = kNone;
  std::string text; ///< the constant, or the parameter's name
  bool operator==(const Naming&) const = default;
};

/// One kind of access to one thing, wherever it stands.
struct Use {
  std::string by; ///< the function or statement: "surface", "texture", "illuminance"...
  Naming name;
  std::vector<SourceRange> places; ///< in source order
};

struct CallUse {
  ShadeopId shadeop = kNoShadeop;
  std::shared_ptr<const slvm::PluginShadeop> plugin; ///< null: a built-in
  std::vector<SourceRange> places;
  const slvm::ShadeopInfo& info() const { return plugin ? plugin->info() : slvm::shadeop(shadeop); }
};

struct Uses {
  std::vector<CallUse> calls;             ///< by name
  std::vector<Use> messages;              ///< values of other shaders; by gather: "surface:Ci"
  std::vector<Use> sent;                  ///< values that light loops send to lights
  std::vector<Use> textures;              ///< maps and other files
  std::vector<Use> rays;                  ///< with the category of gather
  std::vector<Use> derivatives;           ///< what differentiates
  std::vector<Use> lights;                ///< loops, with their category, and what emits
  std::vector<Use> queries;               ///< attribute, option, rendererinfo, rayinfo
  std::vector<Use> spaces;                ///< coordinate systems but "current"
  std::vector<std::string> read, written; ///< predefined variables
};

/// `calls`: Facts::calls of a program, or those of the source; without code left they do not count.
Uses collect_uses(const slvm::ir::Module& m, const std::vector<slvm::SourceCall>& calls);

} // namespace slc

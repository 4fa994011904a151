#include "render/prims/limit_mesh.h"

#include "slvm/support/own_module.h"

namespace render {

namespace {

SubdivisionModule load() {
  SubdivisionModule module;
  using Fill = void (*)(SubdivisionModule*);
  void* found = slvm::find_in_module("anemone_subdivision", "anemone_subdivision_module",
                                     "without anemone_subdivision.so (OpenSubdiv), which belongs beside the "
                                     "program, there are no subdivision meshes",
                                     module.problem);
  if (found) reinterpret_cast<Fill>(found)(&module);
  return module;
}

} // namespace

const SubdivisionModule& subdivision_module() {
  static const SubdivisionModule kModule = load();
  return kModule;
}

} // namespace render

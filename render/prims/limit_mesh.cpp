#include "render/prims/limit_mesh.h"

#include "slvm/support/own_module.h"

namespace render {

const SubdivisionModule& subdivision_module() {
  static const SubdivisionModule kModule =
      slvm::load_module<SubdivisionModule>("anemone_subdivision", "anemone_subdivision_module",
                                           "without anemone_subdivision.so (OpenSubdiv), which belongs "
                                           "beside the program, there are no subdivision meshes");
  return kModule;
}

} // namespace render

#include "render/rays/embree_library.h"

#include <dlfcn.h>

#include <type_traits>

namespace render {

EmbreeLibrary::EmbreeLibrary(const char* file) {
  void* handle = dlopen(file, RTLD_LAZY | RTLD_LOCAL);
  auto find = [&](auto& function, const char* name) {
    using Function = std::remove_reference_t<decltype(function)>;
    if (problem.empty() && handle) function = reinterpret_cast<Function>(dlsym(handle, name));
    if (function || !problem.empty()) return;
    const char* why = dlerror();
    problem = "Embree cannot be loaded, and there are no rays: ";
    problem += why ? why : "unknown reason";
  };
#define SL_FIND(name) find(this->name, #name);
  SL_EMBREE(SL_FIND)
#undef SL_FIND
}

const char* EmbreeLibrary::usual_file() {
  return EMBREE_LIBRARY;
}

} // namespace render

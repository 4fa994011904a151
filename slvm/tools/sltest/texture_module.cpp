// Textures by the module.
#include "slvm/tools/sltest/services.h"

#include "slvm/tools/sltest/module.h"

#include <fmt/ranges.h>

namespace slvm::sltest {

TextureServices* LazyTextures::get(float shadow_bias) {
  std::lock_guard lock(mutex_);
  if (!loaded_) {
    loaded_ = true;
    using Make = TextureServices* (*)(const char*, float);
    if (auto make = reinterpret_cast<Make>(module_function("sltest_make_textures", "sltest_textures.so")))
      textures_.reset(make(fmt::format("{}", fmt::join(path_, ":")).c_str(), shadow_bias));
  }
  return textures_.get();
}

} // namespace slvm::sltest

// Modules that most tests do without: sltest_images.so, which holds all that needs OpenImageIO,
// sltest_textures.so and sltest_rays.so, which hold parts of the renderer.
#pragma once

namespace slvm::sltest {

/// A function of a module, or null where there is no module. It is looked for beside this program and where
/// it is installed.
void* module_function(const char* name, const char* module = "sltest_images.so");

} // namespace slvm::sltest

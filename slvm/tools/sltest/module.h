// The module sltest_images.so, which holds all that needs OpenImageIO: loading it takes longer than most
// tests.
#pragma once

namespace slvm::sltest {

/// A function of the module, or null where there is no module. The module is looked for beside this program
/// and where it is installed.
void* module_function(const char* name);

} // namespace slvm::sltest

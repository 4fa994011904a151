// Calls foreign code that may throw or crash. PUBLIC. For the first call into a plug-in, which is where a
// broken one shows.
#pragma once

#include <functional>
#include <string>

namespace slvm {

/// Calls `f`. "" when it came back; else what happened: "it threw an exception: ...".
std::string call_catching(const std::function<void()>& f);

/// The same for crashes too (segmentation faults, arithmetic and illegal instructions): "it crashed (...)".
/// What the code held then, locks and memory, stays lost: it must not be called again. Other threads' crashes
/// are not caught.
std::string call_guarded(const std::function<void()>& f);

} // namespace slvm

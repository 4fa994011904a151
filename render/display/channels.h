// What the displays ask for: modes ("rgba", "varying normal N", "a,b") and parameters, understood.
#pragma once

#include "render/hider/image.h"
#include "render/state/options.h"
#include "slvm/support/diagnostics.h"
#include "slvm/support/result.h"

#include <string>
#include <vector>

namespace render {

/// One channel of a file.
struct FileChannel {
  std::string name;
  int source = 0; ///< its place in a pixel of the image
  Quantization quantization;
};

/// The channels of the displays that the standard ones do not give, each once, with their places among the
/// AOV floats of a pixel; for an imager also the rest of each picture (colour, opacity, alpha). Modes and
/// parameters that cannot be understood are reported.
std::vector<AovChannel> display_aovs(const Options& options, slvm::Diagnostics& diagnostics);

/// The channels of one display's file. Empty: display_aovs() has reported why.
std::vector<FileChannel> file_channels(const Options& options, const DisplayRequest& display,
                                       const std::vector<AovChannel>& aovs);

/// The standard channels that files of the displays show, or that an imager sees.
Image::StandardChannels shown_channels(const Options& options, const std::vector<AovChannel>& aovs);

} // namespace render

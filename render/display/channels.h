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
  enum class Group : uint8_t { kColor, kDepth, kVariable } group = Group::kColor;
};

/// How a Display wants its pixels. Without own values the frame's are used.
struct DisplaySettings {
  std::optional<PixelFilter> filter;
  std::optional<std::array<float, 2>> exposure; ///< gain and gamma
  std::optional<Quantization> quantize;
  std::optional<float> dither;
};

/// Parameters "filter", "filterwidth", "exposure", "quantize" and "dither". The error says what is wrong.
slvm::Result<DisplaySettings> display_settings(const DisplayRequest&);

/// The channels of the displays that the standard ones do not give, each once, with their places among the
/// AOV floats of a pixel. Modes and parameters that cannot be understood are reported.
std::vector<AovChannel> display_aovs(const Options& options, slvm::Diagnostics& diagnostics);

/// The channels of one display's file. Empty: display_aovs() has reported why.
std::vector<FileChannel> file_channels(const Options& options, const DisplayRequest& display,
                                       const std::vector<AovChannel>& aovs);

} // namespace render

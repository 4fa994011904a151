// A picture on disk of what is finished so far: for people who wait, and for programs that show it.
#pragma once

#include "render/display/channels.h"
#include "render/hider/image.h"

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

namespace render {

/// A PNG file with the colours of the first display that has any, in 8 bits: exposed and quantised as there.
/// What is not finished is dark grey. It is written every half a second at most, and whole at any time.
class Preview {
public:
  Preview(const Options& options, const std::vector<AovChannel>& aovs, std::string file);

  /// Takes over finished pixels. From any thread.
  void add(const Image& image, const PixelRect& rect);
  /// Writes the last picture. "": done, else what was wrong with it or with one before.
  std::string finish();

private:
  using Clock = std::chrono::steady_clock;
  void write(std::vector<uint8_t> pixels);

  std::string file_;
  FileChannel channels_[3];
  PixelRect rect_;
  std::mutex mutex_; ///< of what follows
  std::vector<uint8_t> pixels_;
  Clock::time_point last_ = Clock::now();
  bool writing_ = false;
  std::string problem_;
};

} // namespace render

// Conversion and writing of previews.
#include "render/display/preview.h"

#include "render/display/quantize.h"
#include "render/texture/image_file.h"
#include "slvm/support/whole_file.h"

#include <cstring>

namespace render {

namespace {

constexpr std::chrono::milliseconds kPause{500};
constexpr uint8_t kUnfinished = 48;

/// What a screen can show of a display's numbers.
Quantization for_screen(const Quantization& q) {
  bool small = !q.is_float() && q.min >= 0 && q.max <= 255;
  return small ? q : Quantization{255, 0, 255, 0.5f, true, 0};
}

} // namespace

Preview::Preview(const Options& options, const std::vector<AovChannel>& aovs, std::string file)
    : file_(std::move(file)) {
  for (int c = 0; c < 3; ++c)
    channels_[c] = {std::string(1, "RGB"[c]), Image::kCi + c, options.rgba};
  for (const DisplayRequest& d : options.displays) {
    int found = 0;
    FileChannel rgb[3];
    for (const FileChannel& channel : file_channels(options, d, aovs))
      for (int c = 0; c < 3; ++c)
        if (channel.name == channels_[c].name) rgb[c] = channel, ++found;
    if (found != 3) continue;
    std::copy(rgb, rgb + 3, channels_);
    break;
  }
  for (FileChannel& c : channels_)
    c.quantization = for_screen(c.quantization);
}

void Preview::add(const Image& image, const PixelRect& rect) {
  std::vector<uint8_t> copy;
  {
    std::lock_guard lock(mutex_);
    rect_ = image.rect;
    auto width = static_cast<size_t>(rect_.width());
    if (pixels_.empty()) pixels_.assign(width * static_cast<size_t>(rect_.height()) * 3, kUnfinished);
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x) {
        size_t at = static_cast<size_t>(y - rect_.y0) * width + static_cast<size_t>(x - rect_.x0);
        for (size_t c = 0; c < 3; ++c)
          pixels_[3 * at + c] = static_cast<uint8_t>(quantize(
              image.at(channels_[c].source, x, y), channels_[c].quantization, x, y, channels_[c].source));
      }
    if (writing_ || Clock::now() - last_ < kPause) return;
    writing_ = true;
    copy = pixels_;
  }
  write(std::move(copy)); // the others go on meanwhile
  std::lock_guard lock(mutex_);
  writing_ = false;
  last_ = Clock::now();
}

void Preview::write(std::vector<uint8_t> pixels) {
  slvm::WholeFile whole(file_);
  ImageFile file;
  file.path = whole.temporary();
  file.format = "png";
  file.width = file.full_width = rect_.width();
  file.height = file.full_height = rect_.height();
  file.channels = {"R", "G", "B"};
  file.pixels.resize(pixels.size());
  std::memcpy(file.pixels.data(), pixels.data(), pixels.size());
  std::string why = write_image_file(file);
  if (why.empty()) why = whole.commit();
  std::lock_guard lock(mutex_);
  if (problem_.empty()) problem_ = why;
}

std::string Preview::finish() {
  if (!pixels_.empty()) write(std::move(pixels_));
  return problem_;
}

} // namespace render

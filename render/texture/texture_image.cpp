#include "render/texture/texture_image.h"

#include <algorithm>
#include <limits>

namespace render {

namespace {

/// Colours times alpha, the last channel. `row`: numbers in a row.
void associate(std::span<std::byte> texels, PixelType type, size_t channels, size_t row) {
  std::vector<float> values(row);
  for (size_t at = 0; at < texels.size(); at += row * bytes_of(type)) {
    to_floats(&texels[at], type, values);
    for (size_t i = 0; i < row; i += channels)
      for (size_t c = 0; c + 1 < channels; ++c)
        values[i + c] *= values[i + channels - 1];
    from_floats(values, type, &texels[at]);
  }
}

} // namespace

void set_wraps(const std::string& modes, TextureHeader& header) {
  const size_t comma = modes.find(',');
  header.swrap = find_wrap(modes.substr(0, comma)).value_or(TextureWrap::kBlack);
  header.twrap = header.swrap;
  if (comma != modes.npos) header.twrap = find_wrap(modes.substr(comma + 1)).value_or(TextureWrap::kBlack);
}

bool halves(ImageSize a, ImageSize b) {
  return (a.width > 1 || a.height > 1) && b == half_of(a);
}

TextureImage::TextureImage(std::unique_ptr<TextureReader> reader, std::atomic<long long>& memory)
    : header_(reader->header()), memory_(memory), reader_(std::move(reader)) {
  std::vector<ImageSize> sizes = header_.levels;
  while (sizes.back().width > 1 || sizes.back().height > 1)
    sizes.push_back(half_of(sizes.back()));
  levels_ = std::vector<Stored>(sizes.size());
  for (size_t i = 0; i < sizes.size(); ++i)
    levels_[i].size = sizes[i];
}

TextureImage::~TextureImage() {
  for (const Stored& l : levels_)
    if (l.ready) memory_ -= static_cast<long long>(l.texels.size() - kReadBeyond);
}

std::string TextureImage::problem() const {
  std::lock_guard lock(mutex_);
  return problem_;
}

TextureImage::Level TextureImage::level(size_t i) const {
  const Stored& l = levels_[i];
  if (!l.ready.load(std::memory_order_acquire)) {
    std::lock_guard lock(mutex_);
    load(i);
  }
  return {l.size.width, l.size.height, l.ready.load(std::memory_order_acquire)};
}

bool TextureImage::numbers(size_t i, FloatImage& out) const {
  const Level from = level(i);
  if (!from.texels) return false;
  out = FloatImage(from.width, from.height, static_cast<size_t>(header_.channels));
  to_floats(from.texels, header_.type, out.numbers);
  return true;
}

/// Called with the lock.
void TextureImage::load(size_t i) const {
  Stored& l = levels_[i];
  if (l.ready || !problem_.empty()) return;
  const auto channels = static_cast<size_t>(header_.channels),
             row_size = static_cast<size_t>(l.size.width) * channels;
  if (row_size * bytes_of(header_.type) > std::numeric_limits<int32_t>::max()) { // lookups count in a row
    problem_ = "its rows are too long";
    return;
  }
  const size_t bytes = static_cast<size_t>(l.size.height) * row_size * bytes_of(header_.type);
  std::vector<std::byte> stored(bytes + kReadBeyond);
  const std::span<std::byte> texels(stored.data(), bytes);
  if (i < header_.levels.size()) {
    problem_ = reader_->read(i, texels);
    if (!problem_.empty()) return;
    if (header_.straight_alpha) associate(texels, header_.type, channels, row_size);
  } else {
    load(i - 1);
    const Stored& larger = levels_[i - 1];
    if (!larger.ready) return;
    const size_t larger_row = static_cast<size_t>(larger.size.width) * channels;
    auto place = [&](int y, size_t row) { return static_cast<size_t>(y) * row * bytes_of(header_.type); };
    auto read = [&](int y, float* row) {
      to_floats(&larger.texels[place(y, larger_row)], header_.type, {row, larger_row});
      return row;
    };
    auto write = [&](int y, const float* row) {
      from_floats({row, row_size}, header_.type, &texels[place(y, row_size)]);
    };
    shrink(larger.size, read, l.size, write, channels, {});
  }
  memory_ += static_cast<long long>(bytes);
  l.texels = std::move(stored);
  l.ready.store(l.texels.data(), std::memory_order_release);
}

} // namespace render

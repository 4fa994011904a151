#include "slvm/tools/sltest/image.h"

#include "slvm/format/slo.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <filesystem>

namespace slvm::sltest {
namespace {

Result<bool> write_text(const std::string& path, const std::string& text) {
  return write_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

/// Portable float map: rows from the bottom up.
Result<bool> write_pfm(const std::string& path, const Variable& v, int nu, int nv) {
  const size_t channels = v.planes();
  if (channels != 1 && channels != 3)
    return Error{fmt::format("{}: .pfm holds 1 or 3 channels, not {}", path, channels)};
  std::string text = fmt::format("{}\n{} {}\n{}\n", channels == 3 ? "PF" : "Pf", nu, nv,
                                 std::endian::native == std::endian::little ? "-1.0" : "1.0");
  for (int y = nv; y-- > 0;)
    for (int x = 0; x < nu; ++x)
      for (size_t c = 0; c < channels; ++c) {
        const float value =
            v.get(c, static_cast<size_t>(y) * static_cast<size_t>(nu) + static_cast<size_t>(x));
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        text.append(bytes, sizeof value);
      }
  return write_text(path, text);
}

Result<bool> write_table(const std::string& path, const Variable& v, int nu, int nv, char separator) {
  std::string text = fmt::format("iu{0}iv", separator);
  for (size_t k = 0; k < v.planes(); ++k)
    text += v.planes() == 1 ? fmt::format("{}{}", separator, v.name)
                            : fmt::format("{}{}[{}]", separator, v.name, k);
  text += '\n';
  for (int y = 0; y < nv; ++y)
    for (int x = 0; x < nu; ++x) {
      text += fmt::format("{}{}{}", x, separator, y);
      for (float value : v.at(static_cast<size_t>(y) * static_cast<size_t>(nu) + static_cast<size_t>(x)))
        text += fmt::format("{}{:.9g}", separator, value);
      text += '\n';
    }
  return write_text(path, text);
}

} // namespace

Result<bool> write_variable(const std::string& path, const Variable& v, int nu, int nv) {
  if (v.type == Type::kString) return Error{fmt::format("{}: {} is a string", path, v.name)};
  const std::string kind = std::filesystem::path(path).extension().string();
  if (kind == ".pfm") return write_pfm(path, v, nu, nv);
  if (kind == ".csv") return write_table(path, v, nu, nv, ',');
  if (kind == ".txt") return write_table(path, v, nu, nv, ' ');
  std::vector<float> pixels;
  for (size_t i = 0; i < static_cast<size_t>(nu) * static_cast<size_t>(nv); ++i)
    for (float value : v.at(i))
      pixels.push_back(value);
  return write_image(path, pixels, nu, nv, static_cast<int>(v.planes()));
}

} // namespace slvm::sltest

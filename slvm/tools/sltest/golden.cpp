#include "slvm/tools/sltest/golden.h"

#include "slvm/tools/sltest/deviation.h"
#include "slvm/tools/sltest/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace slvm::sltest {

namespace fs = std::filesystem;

namespace {

struct Comparison {
  size_t failed = 0; ///< pixels
  double worst = 0;
  size_t worst_pixel = 0, worst_channel = 0;
  bool hard = false;
  std::vector<float> difference; ///< as `pixels`
};

Comparison compare(const Image& golden, const std::vector<float>& pixels, const ImageTolerance& t) {
  Comparison c;
  c.difference.resize(pixels.size());
  const size_t channels = static_cast<size_t>(golden.channels);
  for (size_t pixel = 0; pixel < pixels.size() / channels; ++pixel) {
    bool fails = false;
    for (size_t k = 0; k < channels; ++k) {
      const double a = golden.pixels[pixel * channels + k], b = pixels[pixel * channels + k];
      double off = std::abs(a - b);
      if (a == b || (std::isnan(a) && std::isnan(b))) off = 0;
      if (std::isnan(off)) off = std::numeric_limits<double>::infinity();
      c.difference[pixel * channels + k] = static_cast<float>(off);
      if (off > c.worst) {
        c.worst = off;
        c.worst_pixel = pixel;
        c.worst_channel = k;
      }
      const bool relative = std::isinf(off) || off > t.failrelative * (std::abs(a) + std::abs(b)) / 2;
      fails = fails || (relative && off > t.failthresh);
      c.hard = c.hard || (relative && off > t.hardfail);
    }
    c.failed += fails;
  }
  return c;
}

/// Letters, digits and a few others: what is a file name everywhere.
std::string file_stem(const std::string& text) {
  std::string out;
  for (char c : text)
    out += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '.' || c == '=' ? c : '_';
  return out;
}

class GoldenCheck {
public:
  GoldenCheck(const Case& c, const Prepared& prepared, const GoldenOptions& options,
              std::vector<std::string>& updated)
      : case_(c), grid_(prepared.grid), options_(options), updated_(updated) {}

  /// What is wrong with one picture, or "".
  std::string check(const ImageExpectation& e, const RunResult& result) {
    const Variable* v = result.find(e.variable);
    if (!v) v = grid_.find(e.variable);
    if (!v || v->type == Type::kString) return fmt::format("{}: the shader has no such output", e.variable);
    const std::string file = fs::path(e.file).is_absolute()
                                 ? e.file
                                 : (fs::path(case_.setup.path.front()) / e.file).lexically_normal().string();
    std::vector<float> pixels;
    for (size_t i = 0; i < grid_.points(); ++i)
      for (float x : v->at(i))
        pixels.push_back(x);
    const int channels = static_cast<int>(v->planes());
    std::error_code error;
    if (!fs::exists(file, error))
      return options_.update
                 ? update(file, pixels, channels)
                 : fmt::format("{}: there is no {}; --update-goldens writes it", e.variable, file);
    auto golden = read_image(file, pixels);
    if (!golden) return golden.error();
    if (golden->nu != grid_.nu || golden->nv != grid_.nv || golden->channels != channels) {
      if (options_.update) return update(file, pixels, channels);
      return fmt::format("{}: {} has {} x {} pixels of {} channels, the grid {} x {} points of {}",
                         e.variable, file, golden->nu, golden->nv, golden->channels, grid_.nu, grid_.nv,
                         channels);
    }
    const Comparison c = compare(*golden, golden->rounded, e.tolerance);
    const double percent = 100.0 * static_cast<double>(c.failed) / static_cast<double>(grid_.points());
    if (!c.hard && percent <= e.tolerance.failpercent) return "";
    if (options_.update) return update(file, pixels, channels);
    const size_t first = c.worst_pixel * static_cast<size_t>(channels);
    auto pixel_at = [&](const std::vector<float>& list) {
      return exact_text(std::vector<float>(list.begin() + static_cast<std::ptrdiff_t>(first),
                                           list.begin() + static_cast<std::ptrdiff_t>(first) + channels));
    };
    std::string text = fmt::format(
        "{}: differs from {}: {} of {} pixels ({:.3g}%) are off by more than {:g}; worst {:.3g} "
        "(component {}) at {}: expected {}, got {}",
        e.variable, file, c.failed, grid_.points(), percent, e.tolerance.failthresh, c.worst, c.worst_channel,
        point_text(grid_, c.worst_pixel), pixel_at(golden->pixels), pixel_at(golden->rounded));
    return text + store(e, pixels, c.difference, channels);
  }

private:
  std::string update(const std::string& file, const std::vector<float>& pixels, int channels) {
    std::error_code error;
    if (fs::path(file).has_parent_path()) fs::create_directories(fs::path(file).parent_path(), error);
    auto written = write_image(file, pixels, grid_.nu, grid_.nv, channels, PixelSize::kSmall);
    if (!written) return written.error();
    updated_.push_back(file);
    return "";
  }

  /// Writes the result and the difference; says where they are.
  std::string store(const ImageExpectation& e, const std::vector<float>& pixels,
                    const std::vector<float>& difference, int channels) {
    std::error_code error;
    fs::create_directories(options_.failures, error);
    const fs::path stem = fs::path(options_.failures) / file_stem(fs::path(case_.where.file).stem().string() +
                                                                  "-" + case_.name + "-" + e.variable);
    const std::string result_file = stem.string() + ".exr",
                      difference_file = stem.string() + "-difference.exr";
    for (const auto& [file, values] :
         {std::pair(result_file, &pixels), std::pair(difference_file, &difference)})
      if (auto written = write_image(file, *values, grid_.nu, grid_.nv, channels, PixelSize::kFull); !written)
        return "\n    " + written.error();
    return fmt::format("\n    see {} and {}", result_file, difference_file);
  }

  const Case& case_;
  const GridData& grid_;
  const GoldenOptions& options_;
  std::vector<std::string>& updated_;
};

} // namespace

std::vector<CheckFailure> check_goldens(const Case& c, const Prepared& prepared, const RunResult& result,
                                        const GoldenOptions& options, std::vector<std::string>& updated) {
  std::vector<CheckFailure> failures;
  GoldenCheck check(c, prepared, options, updated);
  for (const ImageExpectation& e : c.images)
    if (std::string text = check.check(e, result); !text.empty())
      failures.push_back({e.where, std::move(text)});
  return failures;
}

} // namespace slvm::sltest

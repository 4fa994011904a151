// The whole chain as tests of pictures use it: RIB text with RSL texts, rendered to a few pixels.
#pragma once

#include "render/renderer.h"
#include "tests/render/shader_texts.h"
#include "tests/temp_folder.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace render::testing {

class RendererTest : public ::testing::Test {
protected:
  void SetUp() override {
    settings_.shader_loader = [this](const std::string& name, const std::vector<std::string>& path) {
      return load(name, path);
    };
    settings_.print = [this](std::string_view text) { printed_ += text; };
    settings_.threads = 1;
  }

  /// Renders size_ x size_ pixels to float channels; the messages are returned.
  std::string render(const std::string& rib, const std::string& mode = "rgba") {
    slvm::SourceManager sources;
    slvm::Diagnostics diagnostics;
    Renderer renderer(sources, diagnostics, settings_);
    std::string file = (directory_ / "out.exr").string();
    renderer.read_text("scene.rib",
                       fmt::format("Format {0} {0} 1\n{1}Display \"{2}\" \"openexr\" \"{3}\"\n{4}", size_,
                                   head_, file, mode, rib));
    renderer.finish();
    read(file);
    return format_diagnostics(diagnostics, sources);
  }

  float value(int x, int y, int c) const {
    return pixels_[static_cast<size_t>((y * size_ + x) * channels_ + c)];
  }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  /// RSL sources by shader name.
  std::map<std::string, std::string> shaders_;
  RendererSettings settings_;
  std::string printed_;
  int size_ = 16;
  std::string head_ = "PixelFilter \"box\" 1 1\n"; ///< options of all pictures
  std::vector<float> pixels_;

private:
  slvm::Result<std::string> load(const std::string& name, const std::vector<std::string>& path) {
    return compile_shader_text(shaders_, name, path);
  }

  void read(const std::string& file) {
    pixels_.clear();
    auto in = OIIO::ImageInput::open(file);
    if (!in) return;
    channels_ = in->spec().nchannels;
    pixels_.resize(static_cast<size_t>(size_ * size_ * channels_));
    in->read_image(0, 0, 0, channels_, OIIO::TypeDesc::FLOAT, pixels_.data());
  }

  anemone::test::TempFolder directory_;
  int channels_ = 0;
};

/// Ambient and diffuse light.
inline constexpr const char* kMatte =
    "surface matte(float Ka = 1, Kd = 1) { normal Nf = faceforward(normalize(N), I); "
    "Oi = Os; Ci = Os * Cs * (Ka * ambient() + Kd * diffuse(Nf)); }";
/// A colour whatever the light.
inline constexpr const char* kShow =
    "surface show(float k = 1; color tint = 1) { Ci = k * tint * Cs; Oi = 1; }";

} // namespace render::testing

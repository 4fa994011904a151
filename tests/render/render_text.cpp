// Helpers of the renderer's tests.
#include "tests/render/render_text.h"

#include "render/display/output.h"

#include <gtest/gtest.h>

#include <cmath>

namespace render::testing {

namespace {

class PlainGridShader : public GridShader {
public:
  explicit PlainGridShader(const PlainShading& shading) : shading_(shading) {}

  bool displace(const Primitive&, slvm::Grid& grid) override {
    if (shading_.displacement == 0) return false;
    float* P = grid.varying(slvm::Global::kP);
    float* N = grid.varying(slvm::Global::kN);
    size_t pitch = grid.pitch();
    for (size_t k = 0; k < grid.points(); ++k) {
      float length = std::hypot(N[k], N[pitch + k], N[2 * pitch + k]);
      for (size_t c = 0; c < 3; ++c)
        P[c * pitch + k] += shading_.displacement * N[c * pitch + k] / length;
    }
    return true;
  }

  void shade(const Primitive&, slvm::Grid& grid) override {
    if (shading_.headlight) {
      shade_by_default(grid);
      return;
    }
    float* Ci = grid.varying(slvm::Global::kCi);
    float* Oi = grid.varying(slvm::Global::kOi);
    const slvm::Planes &Cs = grid.variable(slvm::Global::kCs), &Os = grid.variable(slvm::Global::kOs);
    for (size_t k = 0; k < grid.points(); ++k)
      for (size_t c = 0; c < 3; ++c) {
        Oi[c * grid.pitch() + k] = Os.get(c, k);
        Ci[c * grid.pitch() + k] = Os.get(c, k) * Cs.get(c, k);
      }
  }

  const slvm::Planes* output(const Primitive&, const slvm::Grid& grid, std::string_view name) override {
    slvm::Global g = slvm::find_global(name);
    return g == slvm::Global::kCount ? grid.primvar(std::string(name)) : &grid.variable(g);
  }

  /// An imager that swaps red and blue.
  void image(const ShaderRequest&, slvm::Grid& grid) override {
    float* Ci = grid.varying(slvm::Global::kCi);
    for (size_t k = 0; k < grid.points(); ++k)
      std::swap(Ci[k], Ci[2 * grid.pitch() + k]);
  }

private:
  const PlainShading& shading_;
};

} // namespace

std::unique_ptr<GridShader> PlainShading::make_grid_shader() {
  return std::make_unique<PlainGridShader>(*this);
}

Color Rendered::Ci(int x, int y) const {
  return {image.at(Image::kCi, x, y), image.at(Image::kCi + 1, x, y), image.at(Image::kCi + 2, x, y)};
}

void expect_alike(const Image& a, const Image& b) {
  ASSERT_EQ(a.data.size(), b.data.size());
  for (int c = 0; c < a.channels; ++c)
    for (int y = a.rect.y0; y < a.rect.y1; ++y)
      for (int x = a.rect.x0; x < a.rect.x1; ++x) {
        const float value = a.at(c, x, y);
        EXPECT_NEAR(value, b.at(c, x, y), c == Image::kZ ? value * 1e-5f : 0) << c << " " << x << " " << y;
      }
}

double Rendered::covered() const {
  double sum = 0;
  for (int y = image.rect.y0; y < image.rect.y1; ++y)
    for (int x = image.rect.x0; x < image.rect.x1; ++x)
      sum += alpha(x, y);
  return sum;
}

Rendered render_text(const std::string& rib, const FrameSettings& settings, PlainShading& shading) {
  Rendered out;
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  Interpreter interpreter(sources, diagnostics, [&](Scene& scene) {
    out.report = {};
    FrameSettings with_variables = settings;
    with_variables.make_content = [&](const Procedural& p, float area) {
      return interpreter.make_content(p, area);
    };
    if (settings.aovs.empty()) with_variables.aovs = display_aovs(scene.options, diagnostics);
    out.image = render_frame(scene, shading, with_variables, out.report);
    out.scene = std::move(scene);
  });
  interpreter.read_text("test.rib", rib);
  interpreter.finish();
  out.messages = format_diagnostics(diagnostics, sources);
  return out;
}

Rendered render_text(const std::string& rib, const FrameSettings& settings, bool headlight) {
  PlainShading shading;
  shading.headlight = headlight;
  return render_text(rib, settings, shading);
}

std::string messages_of(const std::string& rib) {
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  Interpreter interpreter(sources, diagnostics, {});
  interpreter.read_text("test.rib", rib);
  interpreter.finish();
  return format_diagnostics(diagnostics, sources);
}

} // namespace render::testing

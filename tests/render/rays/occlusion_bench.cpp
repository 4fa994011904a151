// occlusion() beside gather() of equal error: a still life lit by nothing but the share of the sky that each
// point sees, as both say it, and how far each picture is from one with very many rays. All pictures are made
// in one process, on one thread, by user time. Usage: occlusion_bench [test | width [rays of the reference]];
// "test" only looks at a small picture whether both agree.
//
// The time of a gather of equal error is that between the two measured ones whose errors hold it, on the
// straight line between them in logarithms.
#include "render/renderer.h"
#include "render/statistics.h"
#include "tests/render/shader_texts.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// The file pictures are written to, which goes with the program.
struct PictureFile {
  PictureFile() : path(fs::temp_directory_path() / fmt::format("occlusion_bench_{}.exr", ::getpid())) {}
  ~PictureFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
  fs::path path;
};

double user_seconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

struct Picture {
  std::vector<float> pixels;
  double seconds = 0;
  size_t rays = 0, points = 0;
};

class Bench {
public:
  explicit Bench(int width) : width_(width) {}

  Picture render(const std::string& surface) {
    Picture out;
    render::RendererSettings settings;
    settings.threads = 1;
    settings.shader_loader = [this](const std::string& name, const std::vector<std::string>& path) {
      return render::testing::compile_shader_text(shaders_, name, path);
    };
    settings.statistics = [&](const render::FrameStatistics& s) {
      out.rays = s.rays.all();
      out.points = s.rays.hemispheres;
    };
    slvm::SourceManager sources;
    slvm::Diagnostics diagnostics;
    render::Renderer renderer(sources, diagnostics, settings);
    const std::string file = file_.path.string();
    const double before = user_seconds();
    renderer.read_text("scene.rib", scene(file, surface));
    renderer.finish();
    out.seconds = user_seconds() - before;
    if (std::string text = format_diagnostics(diagnostics, sources); !text.empty()) fmt::print("{}", text);
    auto in = OIIO::ImageInput::open(file);
    if (!in) std::abort();
    out.pixels.resize(static_cast<size_t>(width_ * height()));
    in->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, out.pixels.data());
    return out;
  }

private:
  int height() const { return width_ * 3 / 4; }

  std::string scene(const std::string& file, const std::string& surface) const {
    return fmt::format(
        "Format {} {} 1 PixelSamples 4 4 Display \"{}\" \"openexr\" \"rgba\" "
        "Projection \"perspective\" \"fov\" 24 Translate 0 -.4 8 Rotate -38 1 0 0 Rotate 25 0 1 0 WorldBegin "
        "Attribute \"visibility\" \"trace\" 1 Attribute \"trace\" \"float bias\" .004 {} "
        "Polygon \"P\" [-6 0 6 6 0 6 6 0 -6 -6 0 -6] "
        "TransformBegin Translate .8 .6 -.2 Sphere .6 -.6 .6 360 TransformEnd "
        "TransformBegin Translate -.9 0 .1 Rotate 30 0 1 0 "
        "PointsPolygons [4 4 4 4 4] [0 1 2 3 1 5 6 2 5 4 7 6 4 0 3 7 3 2 6 7] \"P\" [-.5 .01 -.5 .5 .01 -.5 "
        ".5 1 -.5 "
        "-.5 1 -.5 -.5 .01 .5 .5 .01 .5 .5 1 .5 -.5 1 .5] TransformEnd "
        "TransformBegin Translate 0 .2 -1.2 Rotate -90 1 0 0 Torus .35 .2 0 360 360 TransformEnd WorldEnd",
        width_, height(), file, surface);
  }

  int width_;
  std::map<std::string, std::string> shaders_ = {
      {"plain", "surface plain() { Ci = 1; Oi = 1; }"},
      {"gathered",
       "surface gathered(float samples = 16) { normal n = faceforward(normalize(N), I); float hits = "
       "0; gather(\"illuminance\", P, n, PI/2, samples, \"distribution\", \"cosine\") hits += 1; "
       "Ci = 1 - hits / samples; Oi = 1; }"},
      {"occluded",
       "surface occluded(float samples = 16, fewest = 0) { normal n = faceforward(normalize(N), I);"
       "Ci = 1 - occlusion(P, n, samples, \"minsamples\", fewest); Oi = 1; }"}};
  PictureFile file_;
};

double rms(const Picture& a, const Picture& b) {
  double sum = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i)
    sum += std::pow(static_cast<double>(a.pixels[i] - b.pixels[i]), 2);
  return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

constexpr const char* kInterpolated = "Attribute \"irradiance\" \"float maxerror\" .5 Surface \"occluded\" ";

/// Both ways come to the same picture, and interpolation is worth it.
bool agree() {
  Bench bench(64);
  const Picture exact = bench.render("Surface \"gathered\" \"samples\" 512"),
                gathered = bench.render("Surface \"gathered\" \"samples\" 64"),
                occluded = bench.render(std::string(kInterpolated) + "\"samples\" 256"),
                adaptive = bench.render(std::string(kInterpolated) + "\"samples\" 256 \"fewest\" 64");
  fmt::print("errors: gather {:.4f}, occlusion {:.4f}, adaptive {:.4f}; rays of the last two {}, {}\n",
             rms(gathered, exact), rms(occluded, exact), rms(adaptive, exact), occluded.rays, adaptive.rays);
  return rms(gathered, exact) < 0.02 && rms(occluded, exact) < 0.02 && rms(adaptive, exact) < 0.02 &&
         2 * occluded.rays < exact.rays && 4 * adaptive.rays < 3 * occluded.rays;
}

} // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "test") return agree() ? 0 : 1;
  const int width = argc > 1 ? std::atoi(argv[1]) : 200, most = argc > 2 ? std::atoi(argv[2]) : 4096;
  Bench bench(width);
  const Picture exact = bench.render(fmt::format("Surface \"gathered\" \"samples\" {}", most));
  const double plain = bench.render("Surface \"plain\"").seconds;
  fmt::print("the picture without rays {:.2f} s; reference {} rays a point, {:.1f} s\n", plain, most,
             exact.seconds);
  struct Row {
    double error, seconds, rays;
  };
  std::vector<Row> gathers;
  for (int samples : {8, 16, 32, 64, 128, 256}) {
    const Picture p = bench.render(fmt::format("Surface \"gathered\" \"samples\" {}", samples));
    gathers.push_back({rms(p, exact), p.seconds, static_cast<double>(p.rays)});
    fmt::print("gather {:3}: error {:.5f}, {:.2f} s, {:.2f} million rays\n", samples, gathers.back().error,
               p.seconds, gathers.back().rays / 1e6);
  }
  auto equal = [&](double error) {
    size_t i = 0;
    while (i + 2 < gathers.size() && gathers[i + 1].error > error)
      ++i;
    const Row &a = gathers[i], &b = gathers[i + 1];
    const double t = std::log(error / a.error) / std::log(b.error / a.error);
    auto between = [&](double x, double y) { return std::exp(std::log(x) + t * std::log(y / x)); };
    return Row{error, between(a.seconds, b.seconds), between(a.rays, b.rays)};
  };
  for (const char* how :
       {"\"samples\" 64", "\"samples\" 256", "\"samples\" 256 \"fewest\" 64", "\"samples\" 1024"}) {
    const Picture p = bench.render(std::string(kInterpolated) + how);
    const Row same = equal(rms(p, exact));
    fmt::print(
        "occlusion {}: error {:.5f}, {:.2f} s, {:.2f} million rays at {} points; gather of equal error: "
        "{:.2f} s ({:.1f}x; without the rest of the picture {:.1f}x), rays {:.1f}x\n",
        how, same.error, p.seconds, static_cast<double>(p.rays) / 1e6, p.points, same.seconds,
        same.seconds / p.seconds, (same.seconds - plain) / (p.seconds - plain),
        same.rays / static_cast<double>(p.rays));
  }
  return 0;
}

// The comparison of Jensen and Buhler 2002, section 5: a translucent teapot in two passes with an octree of
// samples, beside sampling the dipole anew at every point; and by how much the pictures differ. A run of
// slrender each. Usage: teapot_bench [--check]
//
// Noise of sampled pictures falls at least as fast as 1/sqrt(samples), so the time for equal error is that of
// the measured picture times the square of the ratio of the errors.
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <unistd.h>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// A folder that goes with the program.
struct Folder {
  Folder() : path(fs::temp_directory_path() / fmt::format("teapot_bench_{}", ::getpid())) {
    fs::create_directories(path);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
  fs::path path;
};

// 31 mm tall, of marble.
constexpr const char* kPot =
    "Translate 0 -14 0\nRotate 25 0 1 0\nRotate -90 1 0 0\nScale 10 10 10\nGeometry \"teapot\"\n";
constexpr const char* kLights = "LightSource \"sun\" 1 \"from\" [-.6 1 -1] \"to\" [0 0 0] \"intensity\" 1\n"
                                "LightSource \"sun\" 2 \"from\" [1 .5 .6] \"to\" [0 0 0] \"intensity\" .8\n";
constexpr const char* kSun = "light sun(float intensity = 1; point from = 0, to = 0;) {\n"
                             "  vector axis = normalize(to - from);\n"
                             "  solar(axis, 0) Cl = intensity * transmission(Ps, Ps - 1000 * axis);\n}\n";
// The small teapot has fewer samples, which must be no farther apart than light gets: its marble is thinner.
std::string marble(bool small) {
  return fmt::format("color albedo = color (.830, .791, .753), path = {} * color (8.509, 5.566, 3.951);\n",
                     small ? 3 : 1);
}
constexpr const char* kHead = "#include \"subsurface.h\"\n#include \"pointscattering.h\"\n";

class Bench {
public:
  explicit Bench(bool small) : small_(small) {
    folder_.write("sun.sl", kSun);
    folder_.write("points.sl",
                  fmt::format("{}surface points(uniform float epsilon = .1;) {{\n{}"
                              "Oi = 1; Ci = diffusion(transform(\"world\", P), \"lit.ply\", albedo, path, "
                              "1.5, epsilon);\n}}\n",
                              kHead, marble(small)));
    folder_.write("sampled.sl",
                  fmt::format("{}surface sampled(uniform float samples = 16;) {{\n{}"
                              "Oi = 1; Ci = diffusionscattering(P, normalize(N), albedo, path, 1.5, "
                              "samples, \"\", \"\");\n}}\n",
                              kHead, marble(small)));
  }

  /// Seconds.
  double run(const std::string& command) {
    const auto begin = std::chrono::steady_clock::now();
    if (std::system(fmt::format("cd '{}' && {}", folder_.path.string(), command).c_str()) != 0)
      failed_ = true;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  double render(const std::string& rib) {
    folder_.write("a.rib", rib);
    return run("'" SLRENDER_PROGRAM "' a.rib");
  }

  double bake(size_t samples) {
    const int pixels = small_ ? 300 : 900;
    const double seconds = render(fmt::format(
        "Format {0} {0} 1\nPixelSamples 1 1\nProjection \"orthographic\"\nScreenWindow -45 45 -45 45\n"
        "Display \"null\" \"null\" \"rgba\"\nTranslate 0 0 100\nWorldBegin\n"
        "Attribute \"cull\" \"hidden\" 0 \"backfacing\" 0\nAttribute \"dice\" \"rasterorient\" 0\n"
        "Surface \"bakepoints\" \"file\" \"all.ply\"\n{1}WorldEnd\n",
        pixels, kPot));
    return seconds + run(fmt::format("'" SLPOINTS_PROGRAM "' all.ply points.ply --count {}", samples));
  }
  double light() {
    return render(
        fmt::format("Format 8 8 1\nPixelSamples 1 1\nDisplay \"null\" \"null\" \"rgba\"\nTranslate 0 0 100\n"
                    "WorldBegin\n{}Surface \"lightpoints\" \"input\" \"points.ply\" \"result\" \"lit.ply\"\n"
                    "Points \"P\" [0 0 0] \"constantwidth\" 1\n"
                    "Attribute \"visibility\" \"camera\" 0 \"transmission\" \"opaque\"\n{}WorldEnd\n",
                    kLights, kPot));
  }
  /// Also the picture: colours, then alpha, of each pixel.
  double picture(const std::string& surface, std::vector<float>& pixels) {
    const double seconds = render(fmt::format(
        "Format {} {} 1\nPixelSamples 1 1\nPixelFilter \"box\" 1 1\nHider \"hidden\" \"int jitter\" 0\n"
        "Display \"out.tif\" \"tiff\" \"rgba\" \"float[4] quantize\" [0 0 0 0]\n"
        "Projection \"perspective\" \"fov\" 30\nTranslate 0 0 120\nWorldBegin\n{}"
        "Attribute \"visibility\" \"int trace\" 1 \"transmission\" \"opaque\"\nSurface {}\n{}WorldEnd\n",
        small_ ? 40 : 160, small_ ? 30 : 120, kLights, surface, kPot));
    auto in = OIIO::ImageInput::open((folder_.path / "out.tif").string());
    pixels.assign(static_cast<size_t>(in ? 4 * in->spec().width * in->spec().height : 0), 0.0f);
    if (!in || !in->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, pixels.data())) failed_ = true;
    return seconds;
  }
  bool failed() const { return failed_; }

private:
  bool small_;
  Folder folder_;
  bool failed_ = false;
};

/// Root mean square of the difference over the mean of b, where there is a teapot.
double difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0, mean = 0;
  size_t count = 0;
  for (size_t i = 0; i + 3 < std::min(a.size(), b.size()); i += 4) {
    if (b[i + 3] < 1) continue;
    ++count;
    for (size_t c = 0; c < 3; ++c) {
      const auto off = static_cast<double>(a[i + c] - b[i + c]);
      sum += off * off / 3;
      mean += static_cast<double>(b[i + c]) / 3;
    }
  }
  return count ? std::sqrt(sum / static_cast<double>(count)) / (mean / static_cast<double>(count)) : 1;
}

double mean(const std::vector<float>& a) {
  double sum = 0;
  for (size_t i = 0; i + 3 < a.size(); i += 4)
    sum += static_cast<double>(a[i] + a[i + 1] + a[i + 2]);
  return sum;
}

bool compare(bool small) {
  Bench bench(small);
  const size_t samples = small ? 80000 : 150000;
  const int few = small ? 16 : 64, many = small ? 256 : 1024;
  std::vector<float> exact, picture, reference;
  const double bake = bench.bake(samples), light = bench.light();
  const double all = bench.picture("\"points\" \"epsilon\" 0", exact);
  std::printf("%zu samples: made in %.2f s, lit in %.2f s; picture by the sum over all %.2f s\n", samples,
              bake, light, all);
  const double longest = bench.picture(fmt::format("\"sampled\" \"samples\" {}", many), reference);
  const double seconds = bench.picture(fmt::format("\"sampled\" \"samples\" {}", few), picture);
  const double noise = difference(picture, reference), apart = difference(exact, reference);
  std::printf(
      "sampled: %d a point %.2f s, rms error %.3f; %d a point %.2f s, which differs from the sum by %.3f\n",
      few, seconds, noise, many, longest, apart);
  std::puts("epsilon  picture, s  rms error  sampled to this error, s  two passes faster by");
  double error = 0;
  for (float epsilon : {1.0f, 0.3f, 0.1f}) {
    const double lookups = bench.picture(fmt::format("\"points\" \"epsilon\" {}", epsilon), picture);
    error = difference(picture, exact);
    const double equal = seconds * std::pow(noise / error, 2);
    std::printf("%7.1f %11.2f %10.4f %25.0f %21.0f\n", static_cast<double>(epsilon), lookups, error, equal,
                equal / (light + lookups));
  }
  // Single pixels of the sampled picture are noise, all together are not.
  const double brighter = mean(reference) / mean(exact) - 1;
  std::printf("all together the sampled picture is brighter by %.3f\n", brighter);
  return !bench.failed() && error < 0.01 && std::abs(brighter) < 0.08;
}

} // namespace

int main(int argc, char** argv) {
  if (argc > 2 || (argc == 2 && std::strcmp(argv[1], "--check") != 0)) {
    std::fputs("usage: teapot_bench [--check]\n", stderr);
    return 2;
  }
  return compare(argc == 2) ? 0 : 1;
}

// What rays cost beside bare Embree, and what shading their hits costs beside one dense grid. Both sides run
// in turn in one process, on one thread; results are compared before anything is timed. Usage: rays_bench
// [test | shade [rounds [name]]]: "test" compares only, "shade" leaves out Embree; only cases whose names
// hold `name`.
#include "render/texture/image_file.h"
#include "slvm/format/slo.h"
#include "tests/bench/scratch_file.h"
#include "tests/render/rays/ray_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <random>
#include <string>

namespace {

using render::Vec3;
using render::testing::RayScene;

constexpr int kRounds = 15; ///< unless the user says otherwise
constexpr size_t kBatch = 8192;

/// Of this thread alone: others on the machine do not count.
template <class F> double seconds_of(F&& f) {
  auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  f();
  return now() - start;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// 16 x 16 balls on a floor: about a million triangles.
std::string balls() {
  std::string rib = "Format 1000 1000 1 Projection \"perspective\" \"fov\" 40 WorldBegin Attribute "
                    "\"visibility\" \"trace\" 1 "
                    "Attribute \"trace\" \"float bias\" .003 Surface \"shiny\" Translate 0 -3 14 ";
  for (int i = 0; i < 256; ++i)
    rib += fmt::format("TransformBegin Translate {} .4 {} Sphere .4 -.4 .4 360 TransformEnd ", i % 16 - 7.5,
                       i / 16 - 3);
  return rib + "Polygon \"P\" [-20 0 -20 20 0 -20 20 0 40 -20 0 40] WorldEnd";
}

/// Rays of ambient occlusion: from points of the floor and the balls, by cosine about their normals.
struct Rays {
  std::vector<float> origin[3], direction[3], direction_du[3], direction_dv[3], still;
  std::vector<uint32_t> point, sample;

  void add(Vec3 p, Vec3 n, int samples, std::mt19937& random) {
    std::uniform_real_distribution<float> unit;
    Vec3 x = glm::normalize(glm::cross(n, std::abs(n.x) < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0))),
         y = glm::cross(n, x);
    auto number = static_cast<uint32_t>(point.empty() ? 0 : point.back() + 1);
    for (int i = 0; i < samples; ++i) {
      float r2 = unit(random), a = 6.2831853f * unit(random), r = std::sqrt(r2);
      Vec3 d = x * (r * std::cos(a)) + y * (r * std::sin(a)) + n * std::sqrt(1 - r2);
      for (int c = 0; c < 3; ++c) {
        origin[c].push_back(p[c]);
        direction[c].push_back(d[c]);
      }
      point.push_back(number);
      sample.push_back(static_cast<uint32_t>(i));
    }
  }
  /// Gives them widths: neighbours are so far aside, at the distance 1.
  void widen(float by) {
    still.assign(size(), 0.0f);
    for (size_t i = 0; i < size(); ++i) {
      const Vec3 d(direction[0][i], direction[1][i], direction[2][i]);
      const Vec3 x = glm::normalize(glm::cross(d, std::abs(d.x) < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
      const Vec3 y = glm::cross(d, x);
      for (int c = 0; c < 3; ++c) {
        direction_du[c].push_back(by * x[c]);
        direction_dv[c].push_back(by * y[c]);
      }
    }
  }
  size_t size() const { return point.size(); }
  slvm::RayBatch batch(size_t first, size_t count) const {
    slvm::RayBatch b;
    b.count = std::min(count, size() - first);
    for (int c = 0; c < 3; ++c) {
      b.origin[c] = origin[c].data() + first;
      b.direction[c] = direction[c].data() + first;
      if (still.empty()) continue;
      b.origin_du[c] = b.origin_dv[c] = still.data() + first;
      b.direction_du[c] = direction_du[c].data() + first;
      b.direction_dv[c] = direction_dv[c].data() + first;
    }
    b.point = point.data() + first;
    b.sample = sample.data() + first;
    return b;
  }
};

Rays occlusion_rays() {
  Rays rays;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit;
  for (int i = 0; i < 4000; ++i)
    rays.add({unit(random) * 16 - 8, -3, unit(random) * 16 + 10.5f}, {0, 1, 0}, 64, random);
  return rays;
}

/// All faces of the scene in one scene of triangles.
class BareEmbree {
public:
  explicit BareEmbree(const render::Scene& scene)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    render::Camera camera(scene.options);
    std::vector<render::QuadMesh> parts;
    const float open[] = {0};
    for (const render::Primitive& p : scene.primitives)
      render::tessellate(p, render::measure_rate(p, camera, false), nullptr, open, nullptr, parts);
    render::QuadMesh mesh = render::joined(parts, 1);
    triangles = 2 * mesh.faces.size();
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.points.size()));
    for (Vec3 p : mesh.points)
      for (int c = 0; c < 3; ++c)
        *v++ = p[c];
    auto* index = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles));
    for (const auto& f : mesh.faces)
      for (uint32_t k : {f[0], f[1], f[3], f[2], f[3], f[1]})
        *index++ = k;
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene_, g);
    rtcReleaseGeometry(g);
    rtcCommitScene(scene_);
  }
  ~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  /// As RayServices::trace(): with wants_distance, or without.
  void trace(const Rays& rays, float bias, bool nearest, std::vector<float>& distance) const {
#if RTC_VERSION_MAJOR < 4
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
#endif
    for (size_t i = 0; i < rays.size(); ++i) {
      RTCRayHit r{};
      r.ray.org_x = rays.origin[0][i];
      r.ray.org_y = rays.origin[1][i];
      r.ray.org_z = rays.origin[2][i];
      r.ray.dir_x = rays.direction[0][i];
      r.ray.dir_y = rays.direction[1][i];
      r.ray.dir_z = rays.direction[2][i];
      r.ray.tnear = bias;
      r.ray.tfar = render::kInfinity;
      r.ray.mask = ~0u;
      r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR < 4
      nearest ? rtcIntersect1(scene_, &context, &r) : rtcOccluded1(scene_, &context, &r.ray);
#else
      nearest ? rtcIntersect1(scene_, &r, nullptr) : rtcOccluded1(scene_, &r.ray, nullptr);
#endif
      distance[i] = nearest || r.ray.tfar > 0 ? r.ray.tfar : 0;
    }
  }
  size_t triangles = 0;

private:
  RTCDevice device_;
  RTCScene scene_;
};

void trace(RayScene& s, const Rays& rays, const slvm::ShadingState& state, std::span<slvm::RayOutput> outputs,
           std::vector<float>& distance, size_t at_a_time = kBatch, bool nearest = true) {
  slvm::RayOptions options;
  options.wants_distance = nearest;
  options.kind = slvm::RayKind::kDiffuse;
  options.shades = !outputs.empty();
  std::vector<slvm::RayOutput> here(outputs.begin(), outputs.end());
  for (size_t first = 0; first < rays.size(); first += at_a_time) {
    for (size_t k = 0; k < here.size(); ++k)
      here[k].data = outputs[k].data + first;
    s.tracer().trace(state, options, rays.batch(first, at_a_time), here, &distance[first], nullptr);
  }
}

bool compare_with_embree(bool measure) {
  RayScene s(balls(), {{"shiny", "surface shiny() {}"}});
  Rays rays = occlusion_rays();
  BareEmbree bare(s.scene());
  std::vector<float> ours(rays.size()), theirs(rays.size());
  slvm::ShadingState state = (s.asking_grid(1, 1, 0), s.state());
  auto rate = [&](double t) { return static_cast<double>(rays.size()) / t / 1e6; };
  for (const bool nearest : {true, false}) {
    auto trace_theirs = [&] { bare.trace(rays, 0.003f, nearest, theirs); };
    auto trace_ours = [&] { trace(s, rays, state, {}, ours, kBatch, nearest); };
    trace_theirs();
    trace_ours();
    size_t different = 0, hits = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      hits += ours[i] < render::kInfinity;
      different += !(std::abs(ours[i] - theirs[i]) <= 1e-3f) && ours[i] != theirs[i];
    }
    fmt::print("{} triangles, {} rays, {} hits, {} differ\n", bare.triangles, rays.size(), hits, different);
    if (different * 1000 > rays.size()) return false;
    if (!measure) continue;
    std::vector<double> a, b, ratio;
    for (int i = 0; i < kRounds; ++i) { // in turn: other work on the machine slows down both
      a.push_back(seconds_of(trace_theirs));
      b.push_back(seconds_of(trace_ours));
      ratio.push_back(a.back() / b.back());
    }
    fmt::print("{}: bare Embree {:.3f} Mrays/s, ours {:.3f} Mrays/s: {:.0f} %\n",
               nearest ? "nearest hits" : "any hits", rate(median(a)), rate(median(b)), 100 * median(ratio));
  }
  return true;
}

// A shader of usual cost: noise, a lamp, a highlight.
constexpr const char* kShiny =
    "surface shiny() { float n = 0, a = 1; uniform float i; point q = P * 4;"
    "for (i = 0; i < 4; i += 1) { n += a * noise(q); q *= 2; a *= .5; }"
    "vector L = normalize(vector(1,2,-1)), V = normalize(-I); normal Nf = faceforward(normalize(N), I);"
    "Oi = Os; Ci = Cs * (.1 + max(0, Nf.L)) * n + pow(max(0, Nf.normalize(L + V)), 20); }";

// Lights as scenes have them.
constexpr const char* kPlastic =
    "surface shiny(float Ka = 1, Kd = .5, Ks = .5, roughness = .1; color specularcolor = 1) {"
    "normal Nf = faceforward(normalize(N), I); vector V = -normalize(I); Oi = Os;"
    "Ci = Os * (Cs * (Ka * ambient() + Kd * diffuse(Nf)) + specularcolor * Ks * specular(Nf, V, roughness)); "
    "}";
constexpr const char* kSpot =
    "light spot(float intensity = 9; point from = point \"shader\" (0,0,0); point to = point \"shader\" "
    "(0,0,1);"
    "float cone = .8, delta = .1, beam = 2) { uniform vector A = (to - from) / length(to - from);"
    "illuminate(from, A, cone) { float c = (L.A) / length(L); float atten = pow(c, beam) / (L.L);"
    "Cl = intensity * atten * smoothstep(cos(cone), cos(cone - delta), c); } }";

struct ShadedScene {
  const char* name;
  std::string rib, shader;
  int balls;
  bool differ = false;       ///< not all have the same shader
  size_t at_a_time = kBatch; ///< rays
};

/// A picture to look up.
std::string write_texture(const bench::ScratchFile& to) {
  constexpr int kSide = 512;
  render::ImageFile file;
  file.path = to.path();
  file.format = "tiff";
  file.width = file.height = file.full_width = file.full_height = kSide;
  file.channels = {"R", "G", "B"};
  std::mt19937 random(5);
  for (int i = 0; i < 3 * kSide * kSide; ++i)
    file.pixels.push_back(static_cast<std::byte>(random() & 255));
  return render::write_image_file(file);
}

/// Rays from beside the eye to the balls, those of one grid's points one after the other.
Rays rays_to_balls(const ShadedScene& scene) {
  Rays rays;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-1, 1);
  while (rays.size() < 65536) {
    auto ball = static_cast<int>(rays.size()) % scene.balls;
    Vec3 centre(0, 0, 5);
    if (scene.balls > 1)
      centre = Vec3(static_cast<float>(ball % 16) - 7.5f, static_cast<float>(ball / 16) - 7.5f, 5);
    Vec3 p{unit(random) * 3, unit(random) * 3, 0}, aside{unit(random), unit(random), 0};
    Vec3 to = glm::normalize(centre + aside * (scene.balls > 1 ? 0.2f : 0.5f) - p);
    rays.add(p, to, 1, random);
    for (int c = 0; c < 3; ++c)
      rays.direction[c].back() = to[c];
  }
  return rays;
}

void compare_with_grid(const ShadedScene& scene, int rounds) {
  std::string rib = "Format 500 500 1 Projection \"perspective\" \"fov\" 40 WorldBegin ";
  rib += fmt::format("Attribute \"visibility\" \"trace\" 1 {} Surface \"shiny\" ", scene.rib);
  for (int i = 0; i < scene.balls; ++i)
    rib += scene.balls == 1
               ? std::string("Translate 0 0 5 Sphere 1 -1 1 360 ")
               : fmt::format(
                     "{} TransformBegin Translate {} {} 5 Sphere .4 -.4 .4 360 TransformEnd ",
                     scene.differ && i % 32 == 0 ? fmt::format("Surface \"shiny\" \"Kd\" {}", .001 * i) : "",
                     i % 16 - 7.5, i / 16 - 7.5);
  RayScene s(rib + "WorldEnd", {{"shiny", scene.shader}, {"spot", kSpot}});
  Rays rays = rays_to_balls(scene);
  rays.widen(0.005f); // about as far apart as the points of the dense grids
  slvm::ShadingState state = (s.asking_grid(1, 1, 0), s.state());
  std::vector<float> distance(rays.size()), colour(3 * rays.size());
  slvm::RayOutput Ci = RayScene::output(slvm::RayOutput::From::kSurface, "Ci", slvm::Type::kColor);
  Ci.data = colour.data();
  Ci.pitch = rays.size();
  // The same number of points as grids of 16 x 16.
  render::Camera camera(s.scene().options);
  render::DiceContext dice{&camera, &s.machine().strings(), 0, 0};
  slvm::ShadingContext context(s.machine(), s.services());
  slvm::Grid grid(2, 2);
  const slvm::ShaderSet& set = s.shaders(0);
  auto shade_dense = [&] {
    render::GridTask task;
    task.nu = task.nv = 16;
    for (int k = 0; k < 256; ++k) {
      task.rect = {static_cast<float>(k % 16) / 16, static_cast<float>(k % 16 + 1) / 16,
                   static_cast<float>(k / 16) / 16, static_cast<float>(k / 16 + 1) / 16};
      const render::Primitive ball = s.scene().primitives[static_cast<size_t>(k % scene.balls)];
      render::dice({&ball, 1}, task, static_cast<uint64_t>(k), dice, {}, grid);
      context.shade(set, grid);
    }
  };
  std::vector<double> with, without, dense, shading, whole;
  for (int i = 0; i < rounds; ++i) {
    with.push_back(seconds_of([&] { trace(s, rays, state, {&Ci, 1}, distance, scene.at_a_time); }));
    without.push_back(seconds_of([&] { trace(s, rays, state, {}, distance, scene.at_a_time); }));
    dense.push_back(seconds_of(shade_dense));
    shading.push_back((with.back() - without.back()) / dense.back());
    whole.push_back(with.back() / (without.back() + dense.back()));
  }
  auto missed = std::count(distance.begin(), distance.end(), render::kInfinity);
  double per = 1e9 / static_cast<double>(rays.size());
  fmt::print(
      "{}: {} rays miss; rays {:.0f} ns, hits shaded {:.0f} ns, dense grid {:.0f} ns: shading {:.2f}x, whole "
      "gather {:.2f}x\n",
      scene.name, missed, median(without) * per, (median(with) - median(without)) * per, median(dense) * per,
      median(shading), median(whole));
}

void compare_with_grids(int rounds, const std::string& name) {
  auto with = [](const std::string& statement) {
    std::string shader = kShiny;
    return shader.insert(shader.find("Oi = Os"), statement);
  };
  const bench::ScratchFile picture("rays_bench.tif");
  if (std::string problem = write_texture(picture); !problem.empty()) fmt::print("{}\n", problem);
  auto texture = [&](const std::string& at) {
    return with("n *= float texture(\"" + picture.path() + "\", " + at + ");");
  };
  const char* lit = "LightSource \"spot\" 1 \"from\" [4 4 0] \"to\" [0 0 5] LightSource \"spot\" 2 \"from\" "
                    "[-4 4 0] \"to\" [0 0 5] LightSource \"spot\" 3 \"from\" [0 -4 0] \"to\" [0 0 5]";
  for (const ShadedScene& scene :
       {ShadedScene{"noise without derivatives", "", kShiny, 1},
        {"noise with derivatives (three points a hit)", "", with("n *= 1 + .001 * Du(n) * du;"), 1},
        {"noise and a texture at s and t", "", texture("4 * s, 2 * t"), 1},
        {"noise and a texture by reflection", "",
         with("vector R = reflect(normalize(I), normalize(N));"
              "n *= float texture(\"" +
              picture.path() + "\", xcomp(R), ycomp(R));"),
         1},
        {"three lights", lit, kPlastic, 1},
        {"three lights, 256 balls", lit, kPlastic, 256},
        {"three lights, 256 balls, 8 shaders", lit, kPlastic, 256, true},
        {"the same, 256 rays at a time", lit, kPlastic, 256, true, 256}})
    if (std::string(scene.name).find(name) != std::string::npos) compare_with_grid(scene, rounds);
}

} // namespace

int main(int argc, char** argv) {
  const std::string what = argc < 2 ? "" : argv[1];
  bool measure = what != "test";
  if (what != "shade" && !compare_with_embree(measure)) return 1;
  if (measure)
    compare_with_grids(argc < 3 ? kRounds : std::max(std::atoi(argv[2]), 1), argc < 4 ? "" : argv[3]);
  return 0;
}

// Scenes for tests of rays.
#include "tests/render/rays/ray_scene.h"

#include "tests/render/shader_texts.h"

#include "render/state/interpreter.h"

#include <gtest/gtest.h>

namespace render::testing {

RayScene::RayScene(const std::string& rib, std::map<std::string, std::string> shaders,
                   std::vector<std::string> texture_folders)
    : shaders_(std::move(shaders)),
      cache_(machine_,
             [this](const std::string& name, const std::vector<std::string>&) { return load(name); }) {
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  Interpreter interpreter(sources, diagnostics, [&](Scene& scene) { scene_ = std::move(scene); });
  interpreter.read_text("test.rib", rib);
  interpreter.finish();
  TextureMaps::Settings settings;
  settings.folders = std::move(texture_folders);
  textures_ = std::make_unique<TextureMaps>(settings);
  bound_ = std::make_unique<BoundShaders>(scene_, machine_, cache_, diagnostics);
  services_ = std::make_unique<SceneServices>(scene_, *bound_, *textures_, lookups_, points_,
                                              [this](std::string_view text) { printed_ += text; });
  tracer_ = std::make_unique<RayTracer>(scene_, machine_, *bound_, *services_);
  services_->set_rays(tracer_.get());
  messages_ = format_diagnostics(diagnostics, sources);
  shaders_["asking"] = "surface asking() {}";
  auto asking = cache_.find("asking", {});
  running_ = std::move(*machine_.instantiate(*asking, {}, {}));
}

RayScene::~RayScene() = default;

slvm::Result<std::string> RayScene::load(const std::string& name) const {
  return compile_shader_text(shaders_, name);
}

slvm::Grid& RayScene::asking_grid(int nu, int nv, int primitive) {
  grid_.reset(nu, nv);
  if (primitive >= 0) asking_ = scene_.primitives[static_cast<size_t>(primitive)];
  grid_.user = primitive < 0 ? nullptr : &asking_;
  return grid_;
}

slvm::ShadingState RayScene::state() const {
  return {grid_, no_shaders_, *running_};
}

slvm::RayOutput RayScene::output(slvm::RayOutput::From from, std::string_view name, slvm::Type type) {
  slvm::RayOutput out;
  out.from = from;
  out.name = name;
  out.type = type;
  return out;
}

std::vector<TestHit> RayScene::trace(const std::vector<TestRay>& rays,
                                     const std::vector<slvm::RayOutput>& outputs,
                                     const slvm::RayOptions& options, slvm::RayCursor* cursors) {
  size_t n = rays.size();
  std::vector<float> planes[8];
  slvm::RayBatch batch;
  batch.count = n;
  std::vector<uint32_t> numbers(n);
  for (auto& p : planes)
    p.resize(n);
  for (size_t i = 0; i < n; ++i) {
    Vec3 d = glm::normalize(rays[i].direction);
    for (int c = 0; c < 3; ++c) {
      planes[c][i] = rays[i].origin[c];
      planes[3 + c][i] = d[c];
    }
    planes[6][i] = rays[i].max_distance;
    planes[7][i] = rays[i].bias;
    numbers[i] = static_cast<uint32_t>(i);
  }
  std::vector<uint32_t> points(n, 0);
  for (int c = 0; c < 3; ++c) {
    batch.origin[c] = planes[c].data();
    batch.direction[c] = planes[3 + c].data();
  }
  batch.max_distance = planes[6].data();
  batch.bias = planes[7].data();
  batch.point = points.data();
  batch.sample = numbers.data();
  std::vector<slvm::RayOutput> wanted = outputs;
  std::vector<std::vector<float>> values(outputs.size());
  std::vector<std::vector<uint8_t>> found(outputs.size());
  for (size_t k = 0; k < wanted.size(); ++k) {
    size_t width = static_cast<size_t>(slvm::components(wanted[k].type)) * std::max(wanted[k].elements, 1u);
    values[k].assign(width * n, -77);
    found[k].assign(n, 0);
    wanted[k].data = values[k].data();
    wanted[k].pitch = n;
    wanted[k].found = found[k].data();
  }
  std::vector<float> distance(n);
  tracer_->trace(state(), options, batch, wanted, distance.data(), cursors);
  std::vector<TestHit> out(n);
  for (size_t i = 0; i < n; ++i) {
    out[i].distance = distance[i];
    for (size_t k = 0; k < wanted.size(); ++k) {
      out[i].values.emplace_back();
      for (size_t c = 0; found[k][i] && c < values[k].size() / n; ++c)
        out[i].values.back().push_back(values[k][c * n + i]);
      if (!found[k][i]) {
        EXPECT_EQ(values[k][i], -77) << "kept where nothing was found";
      }
    }
  }
  return out;
}

std::vector<float> RayScene::value(const TestRay& ray, const std::string& name, slvm::Type type,
                                   const slvm::RayOptions& options) {
  using From = slvm::RayOutput::From;
  const std::map<std::string, From> kinds = {
      {"surface", From::kSurface},       {"displacement", From::kDisplacement}, {"volume", From::kVolume},
      {"atmosphere", From::kAtmosphere}, {"interior", From::kInterior},         {"exterior", From::kExterior},
      {"primitive", From::kPrimitive},   {"attribute", From::kAttribute},       {"shaded", From::kShaded}};
  size_t colon = name.find(':');
  return trace({ray},
               {output(kinds.at(name.substr(0, colon)), std::string_view(name).substr(colon + 1), type)},
               options)[0]
      .values[0];
}

Color RayScene::transmission(Vec3 from, Vec3 to, const slvm::RayOptions& options) {
  Vec3 d = to - from;
  float length = glm::length(d), zero = 0, out[3];
  d /= length;
  slvm::RayBatch batch;
  batch.count = 1;
  uint32_t number = 0;
  for (int c = 0; c < 3; ++c) {
    batch.origin[c] = &from[c];
    batch.direction[c] = &d[c];
  }
  batch.max_distance = &length;
  batch.bias = &zero;
  batch.point = batch.sample = &number;
  tracer_->transmission(state(), options, batch, {&out[0], &out[1], &out[2]});
  return {out[0], out[1], out[2]};
}

} // namespace render::testing

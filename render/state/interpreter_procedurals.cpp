// Procedurals: kept when they are met, carried out when the renderer comes to them.
#include "render/rib/parser.h"
#include "render/state/interpreter.h"
#include "render/state/search_path.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <unistd.h>

namespace render {

namespace {

constexpr int kDeepest = 64;
constexpr size_t kMostProcedurals = 1'000'000;

/// The first word of a RunProgram as a file that can be run: on the path of procedurals, then that of the
/// environment.
std::optional<std::string> find_program(const std::string& name, std::vector<std::string> path) {
  if (const char* environment = std::getenv("PATH"); environment && name.find('/') == std::string::npos)
    for (std::string& folder : parse_search_path(environment, {}, {}))
      path.push_back(std::move(folder));
  auto found = find_file(name, path);
  if (!found || ::access(found->c_str(), X_OK) != 0) return {};
  // A bare name would be looked for elsewhere.
  return found->find('/') == std::string::npos ? "./" + *found : *found;
}

} // namespace

void Interpreter::procedural(const RequestCall& call) {
  const std::string& type = call.text(0);
  bool archive = type == "DelayedReadArchive", program = type == "RunProgram",
       plug_in = type == "DynamicLoad";
  if (!archive && !program && !plug_in) {
    error_at(call.arguments[0].where, call,
             fmt::format("unknown type \"{}\"; known are DelayedReadArchive, RunProgram, DynamicLoad", type));
    return;
  }
  if (plug_in) {
    warn_once("DynamicLoad", call.where, "rib-unsupported",
              "Procedural \"DynamicLoad\" is not supported yet: what the plug-in would make is missing");
    return;
  }
  size_t wanted = archive ? 1 : 2;
  if (call.texts(1).size() != wanted) {
    error_at(call.arguments[1].where, call,
             fmt::format("\"{}\" takes {}, found {}", type,
                         archive ? "the name of a file" : "a program and the data for it",
                         call.texts(1).size()));
    return;
  }
  if (procedurals_ == kMostProcedurals) {
    error(call, fmt::format("more than {} procedurals in a frame; the request is skipped", kMostProcedurals));
    return;
  }
  auto b = call.numbers(2);
  Procedural p;
  p.type = type;
  p.arguments.assign(call.texts(1).begin(), call.texts(1).end());
  // "Infinite" bounds stay numbers when they are transformed.
  constexpr float kFarthest = 1e15f;
  p.bound = {glm::clamp(Vec3(b[0], b[2], b[4]), -kFarthest, kFarthest),
             glm::clamp(Vec3(b[1], b[3], b[5]), -kFarthest, kFarthest)};
  p.attributes = attributes_;
  p.object_to_camera = ctm_;
  p.motion = motion_;
  p.folder = folder_;
  p.displacement_bound = displacement_bound_of(*attributes_, ctm_);
  p.depth = procedural_depth_ + 1;
  p.where = call.where;
  if (p.bound.empty()) {
    error_at(call.arguments[2].where, call, "the bound is empty; expected xmin xmax ymin ymax zmin zmax");
    return;
  }
  ++procedurals_;
  scene_.procedurals.push_back(std::move(p));
}

SceneContent Interpreter::make_content(const Procedural& p, float area) {
  if (stopped_) return {};
  if (p.depth > kDeepest) {
    report(p, fmt::format("procedurals come out of each other more than {} deep", kDeepest));
    return {};
  }
  auto spaces = spaces_;
  run(p, area);
  scene_.copies.clear();
  SceneContent content{std::exchange(scene_.primitives, {}), std::exchange(scene_.procedurals, {}), {}};
  for (const auto& [name, space] : spaces_)
    if (auto it = spaces.find(name); it == spaces.end() || it->second != space) content.spaces[name] = space;
  return content;
}

void Interpreter::report(const Procedural& p, std::string_view text) {
  if (error_handler_ == ErrorHandling::kIgnore) return;
  diagnostics_.error(p.where, fmt::format("Procedural: {} \"{}\": {}", p.type, p.arguments[0], text));
}

/// With the state of the request; what it changes ends with it.
void Interpreter::run(const Procedural& p, float area) {
  auto attributes = std::exchange(attributes_, p.attributes);
  Matrix4 ctm = std::exchange(ctm_, p.object_to_camera);
  MotionMatrices motion = std::exchange(motion_, p.motion);
  std::string folder = std::exchange(folder_, p.folder);
  std::vector<Block> blocks = std::exchange(blocks_, {});
  procedural_depth_ = p.depth;
  ++depth_;
  if (p.type == "DelayedReadArchive")
    read_archive_file(p.arguments[0], p.where, "Procedural");
  else
    run_program(p, area);
  --depth_;
  procedural_depth_ = 0;
  if (recording_.depth > 0 || !blocks_.empty()) report(p, "a block is left open at its end");
  recording_ = {};
  skip_depth_ = 0;
  in_motion_.reset();
  blocks_ = std::move(blocks);
  folder_ = folder;
  ctm_ = ctm;
  motion_ = std::move(motion);
  attributes_ = attributes;
}

void Interpreter::run_program(const Procedural& p, float area) {
  const std::string& name = p.arguments[0];
  auto it = programs_.find(name);
  if (it == programs_.end()) {
    it = programs_.emplace(name, nullptr).first;
    auto started = start_program(p);
    if (!started) {
      report(p, started.error());
      return;
    }
    it->second = std::move(*started);
  }
  if (!it->second) return; // it failed before, and that was said
  auto answer = it->second->ask(fmt::format("{:g} {}\n", area, p.arguments[1]), program_limits);
  if (!answer) {
    report(p, answer.error());
    it->second.reset();
    return;
  }
  parse_text(fmt::format("<{}>", name), std::move(*answer), false);
}

slvm::Result<std::unique_ptr<Program>> Interpreter::start_program(const Procedural& p) {
  if (!allow_programs) return slvm::Error{"scenes may run programs only with --allow-programs"};
  std::vector<std::string> command;
  std::istringstream words(p.arguments[0]);
  for (std::string word; words >> word;)
    command.push_back(word);
  if (command.empty()) return slvm::Error{"there is no program of this name"};
  std::vector<std::string> path = scene_.options.search_paths["procedural"];
  if (!p.folder.empty()) path.push_back(p.folder);
  auto file = find_program(command[0], path);
  if (!file)
    return slvm::Error{fmt::format("no such program in the search path \"{}\"", fmt::join(path, ":"))};
  command[0] = *file;
  return Program::start(command);
}

} // namespace render

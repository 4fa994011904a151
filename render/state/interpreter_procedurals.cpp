// Procedurals: kept when they are met, carried out when the renderer comes to them.
#include "render/rib/parser.h"
#include "render/state/fragment.h"
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
/// Of those that come out of themselves: with something small in each, that takes some seconds.
constexpr size_t kMostRepetitions = 100'000;

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
       plug_in = type == "DynamicLoad", fragment = type == "Fragment";
  if (!archive && !program && !plug_in && !fragment) {
    error_at(
        call.arguments[0].where, call,
        fmt::format("unknown type \"{}\"; known are DelayedReadArchive, RunProgram, DynamicLoad, Fragment",
                    type));
    return;
  }
  size_t wanted = archive || fragment ? 1 : 2;
  if (call.texts(1).size() != wanted) {
    error_at(call.arguments[1].where, call,
             fmt::format("\"{}\" takes {}, found {}", type,
                         archive    ? "the name of a file"
                         : fragment ? "a mesh as RIB, or the name of a file"
                         : program  ? "a program and the data for it"
                                    : "a plug-in and its parameters",
                         call.texts(1).size()));
    return;
  }
  Procedural* p = keep_procedural(call, call.numbers(2), call.arguments[2].where);
  if (!p) return;
  p->type = type;
  p->arguments.assign(call.texts(1).begin(), call.texts(1).end());
}

void Interpreter::procedural(std::span<const float, 6> bound, std::shared_ptr<GeometryMaker> maker,
                             slvm::SourceRange where) {
  RequestCall call;
  call.id = RequestId::kProcedural;
  call.where = where;
  if (stopped(call) || skip_depth_ > 0 || !legal(call)) return;
  if (recording() || in_motion_) {
    error(call, "a function cannot be kept in an object, an archive or a motion block",
          RiError::kIllegalState);
    return;
  }
  Procedural* p = keep_procedural(call, bound, where);
  if (!p) return;
  p->type = "function";
  p->arguments = {""};
  p->maker = std::move(maker);
}

/// A new procedural with the state of the moment. Null, with a message: it cannot be kept.
Procedural* Interpreter::keep_procedural(const RequestCall& call, std::span<const float> b,
                                         slvm::SourceRange where) {
  if (procedurals_ >= kMostProcedurals) {
    if (procedurals_++ == kMostProcedurals)
      error(call, fmt::format("more than {} procedurals in a frame; the rest is skipped", kMostProcedurals),
            RiError::kLimit);
    return nullptr;
  }
  // "Infinite" bounds stay numbers when they are transformed.
  constexpr float kFarthest = 1e15f;
  Box bound{glm::clamp(Vec3(b[0], b[2], b[4]), -kFarthest, kFarthest),
            glm::clamp(Vec3(b[1], b[3], b[5]), -kFarthest, kFarthest)};
  if (bound.empty()) {
    error_at(where, call, "the bound is empty; expected xmin xmax ymin ymax zmin zmax", RiError::kRange);
    return nullptr;
  }
  ++procedurals_;
  Procedural& p = scene_.procedurals.emplace_back();
  p.bound = bound;
  p.attributes = attributes_;
  p.object_to_camera = ctm_;
  p.motion = motion_;
  p.folder = folder_;
  p.displacement_bound = displacement_bound_of(*attributes_, ctm_);
  p.from = ancestry_;
  p.depth = procedural_depth_ + 1;
  p.may_run = allow_programs || (allow_own_programs && depth_ == 0);
  p.where = call.where;
  // The solids it makes come late: their place among the operands is kept.
  p.solid = solid_;
  if (solid_.in_operation()) p.solid.node = solid_.tree->add(SolidOperation::kUnion, solid_.node);
  return &p;
}

/// Carries out the procedurals among the operands of solids and the surfaces of area lights: these must be
/// known before anything is drawn.
void Interpreter::complete_early() {
  Camera camera(scene_.options);
  const PixelFilter& filter = scene_.options.filter;
  std::vector<Procedural> others;
  for (size_t i = 0; i < scene_.procedurals.size() && !stopped_; ++i) {
    Procedural p = std::move(scene_.procedurals[i]);
    auto seen = seen_bound(p, camera, {filter.xwidth, filter.ywidth});
    if (p.attributes->area_light)
      run(p, (seen ? seen->area : 0) * scene_.options.relative_detail); // may add to the row
    else if (!p.solid.is_operand())
      others.push_back(std::move(p));
    else if (seen)
      run(p, seen->area * scene_.options.relative_detail);
  }
  scene_.procedurals = std::move(others);
}

SceneContent Interpreter::make_content(const Procedural& p, float area) {
  if (stopped_) return {};
  auto spaces = spaces_;
  run(p, area * scene_.options.relative_detail);
  complete_early();
  scene_.copies.clear();
  SceneContent content{std::exchange(scene_.primitives, {}), std::exchange(scene_.procedurals, {}), {}};
  for (const auto& [name, space] : spaces_)
    if (auto it = spaces.find(name); it == spaces.end() || it->second != space) content.spaces[name] = space;
  return content;
}

void Interpreter::report(const Procedural& p, std::string_view text) {
  if (error_handler_ == ErrorHandling::kIgnore) return;
  error_kind_ = RiError::kSystem;
  std::string name = p.maker ? p.type : fmt::format("{} \"{}\"", p.type, p.arguments[0]);
  diagnostics_.error(p.where, fmt::format("Procedural: {}: {}", name, text));
}

/// Whether a procedural is one too many, which is said once of each. Recursion without an end doubles its
/// work with every level: what was found not to end is not begun again.
bool Interpreter::never_ends(const Procedural& p, const std::string& what) {
  bool again = false;
  for (const Ancestry* a = p.from.get(); a && !again; a = a->from.get())
    again = a->what == what;
  if (again && endless_.contains(what)) return true;
  std::string why;
  if (p.depth > kDeepest)
    why = fmt::format("procedurals come out of each other more than {} deep", kDeepest);
  else if (again && ++repetitions_ > kMostRepetitions)
    why = fmt::format("it has come out of itself more than {} times", kMostRepetitions);
  if (why.empty()) return false;
  if (endless_.insert(what).second)
    report(p, fmt::format("{}, and goes no further; one that contains itself needs an end: DetailRange, or "
                          "IfBegin with a count that it keeps in Attribute \"user\"",
                          why));
  return true;
}

/// With the state of the request; what it changes ends with it.
void Interpreter::run(const Procedural& p, float area) {
  const std::string what = p.maker ? fmt::format("function {}", fmt::ptr(p.maker.get()))
                                   : fmt::format("{} {}", p.type, fmt::join(p.arguments, "\n"));
  if (never_ends(p, what)) return;
  auto ancestry = std::exchange(ancestry_, std::make_shared<const Ancestry>(Ancestry{what, p.from}));
  auto attributes = std::exchange(attributes_, p.attributes);
  Matrix4 ctm = std::exchange(ctm_, p.object_to_camera);
  MotionMatrices motion = std::exchange(motion_, p.motion);
  std::string folder = std::exchange(folder_, p.folder);
  SolidPlace solid = std::exchange(solid_, p.solid);
  std::vector<Block> blocks = std::exchange(blocks_, {});
  procedural_depth_ = p.depth;
  bool file = !p.maker; // a function of a program is as good as the program
  if (file) ++depth_;
  if (p.maker)
    p.maker->make(area);
  else if (p.type == "DelayedReadArchive")
    read_archive_file(p.arguments[0], p.where, "Procedural");
  else if (p.type == "DynamicLoad")
    run_plug_in(p, area);
  else if (p.type == "Fragment")
    run_fragment(p);
  else
    run_program(p, area);
  if (file) --depth_;
  procedural_depth_ = 0;
  if (recording_.depth > 0 || !blocks_.empty()) report(p, "a block is left open at its end");
  recording_ = {};
  skip_depth_ = 0;
  in_motion_.reset();
  blocks_ = std::move(blocks);
  solid_ = solid;
  folder_ = folder;
  ctm_ = ctm;
  motion_ = std::move(motion);
  attributes_ = attributes;
  ancestry_ = std::move(ancestry);
}

void Interpreter::run_plug_in(const Procedural& p, float area) {
  const std::string& name = p.arguments[0];
  auto it = plug_ins_.find(name);
  if (it == plug_ins_.end()) {
    it = plug_ins_.emplace(name, nullptr).first;
    auto loaded = load_plug_in(name, procedural_folders, scene_.options.search_paths["procedural"]);
    if (!loaded) {
      report(p, loaded.error());
      return;
    }
    it->second = std::move(*loaded);
  }
  if (!it->second) return; // it failed before, and that was said
  std::string problem;
  auto functions = [&, plug_in = it->second] { problem = plug_in->make(p.arguments[1], area); };
  if (around_plug_in)
    around_plug_in(p.where, functions);
  else
    functions();
  if (!problem.empty()) report(p, problem);
}

void Interpreter::run_fragment(const Procedural& p) {
  FragmentSource source = fragment_source(p.arguments[0]);
  if (scene_.options.projection != ProjectionKind::kOrthographic)
    warn_once(
        "fragment camera", p.where, "rib",
        "Procedural: Fragment: the camera is not orthographic: what shaders transform from \"NDC\" is wrong");
  Fragmenter fragmenter(*this, diagnostics_, declarations_, source.mesh);
  reader_ = &fragmenter;
  const size_t errors = diagnostics_.error_count();
  if (source.file.empty())
    parse_text("<Fragment>", std::move(source.text), false);
  else
    read_archive_file(source.file, p.where, "Procedural");
  reader_ = this;
  if (diagnostics_.error_count() == errors && fragmenter.meshes() <= source.mesh)
    report(p, fmt::format("mesh {} is wanted, but there are {} SubdivisionMesh requests", source.mesh,
                          fragmenter.meshes()));
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
  if (!p.may_run) return slvm::Error{"scenes may run programs only with --allow-programs"};
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

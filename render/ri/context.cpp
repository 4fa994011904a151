// Contexts, and the functions of ri.h that begin, end and choose them or handle errors.
#include "render/ri/context.h"

#include "render/ri/filters.h"
#include "render/ri/render_backend.h"
#include "render/ri/rib_backend.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <mutex>
#include <vector>

namespace render::ri {

namespace {

/// Everything the C interface remembers between calls.
struct Process {
  std::vector<std::unique_ptr<Context>> contexts;
  Context* current = nullptr;
  RtErrorHandler handler = RiErrorPrint; ///< of contexts that begin
  RibOutput output;                      ///< from Option "rib" before RiBegin
  /// Held while functions of the program run, or of plug-ins: they come from the threads that render.
  std::recursive_mutex functions;
};

/// Never destroyed: an error handler may end the program in the middle of a request.
Process& process() {
  static Process* state = new Process;
  return *state;
}

/// A procedural whose geometry a function of the program makes.
class FunctionGeometry : public GeometryMaker {
public:
  FunctionGeometry(Context& context, slvm::SourceRange where, RtPointer data, RtProcSubdivFunc subdivide,
                   RtProcFreeFunc free)
      : context_(context), where_(where), data_(data), subdivide_(subdivide), free_(free) {}
  ~FunctionGeometry() override { release(); }
  FunctionGeometry(const FunctionGeometry&) = delete;
  FunctionGeometry& operator=(const FunctionGeometry&) = delete;
  void make(float detail) override {
    context_.run(where_, [&] { subdivide_(data_, detail); });
    release();
  }

private:
  void release() {
    std::scoped_lock lock(process().functions);
    if (auto free = std::exchange(free_, nullptr)) free(data_);
  }

  Context& context_;
  slvm::SourceRange where_;
  RtPointer data_;
  RtProcSubdivFunc subdivide_;
  RtProcFreeFunc free_;
};

/// The name of a function that stands for a type of Procedural, and how many strings its data holds.
std::pair<const char*, RtInt> procedural_type(RtProcSubdivFunc f) {
  if (f == RiProcDelayedReadArchive) return {"DelayedReadArchive", 1};
  if (f == RiProcRunProgram) return {"RunProgram", 2};
  if (f == RiProcDynamicLoad) return {"DynamicLoad", 2};
  return {nullptr, 0};
}

/// What Option "rib" and the environment ask for (RIFORMAT, RICOMPRESSION, RIPRECISION as in PRMan).
RibOutput rib_output(const std::string& file) {
  RibOutput out = process().output;
  out.file = file;
  auto is = [](const char* variable, std::string_view value) {
    const char* text = std::getenv(variable);
    return text && text == value;
  };
  out.binary = out.binary || is("RIFORMAT", "binary");
  out.gzip = out.gzip || is("RICOMPRESSION", "gzip");
  if (const char* digits = std::getenv("RIPRECISION"); digits && out.precision == 0)
    out.precision = std::clamp(std::atoi(digits), 0, 17);
  return out;
}

} // namespace

void call_handler(RtErrorHandler handler, RiError kind, RtInt severity, const std::string& text) {
  RiLastError = static_cast<RtInt>(kind);
  std::vector<char> message(text.begin(), text.end()); // the handler may write into it
  message.push_back('\0');
  handler(RiLastError, severity, message.data());
}

Context* current() {
  return process().current;
}

Context* set_current(Context* context) {
  return std::exchange(process().current, context);
}

void abandon_files() {
  for (const auto& context : process().contexts)
    context->backend().abandon();
}

void report_outside(RiError kind, const std::string& text) {
  call_handler(process().handler, kind, RIE_ERROR, text);
}

Context* current(const char* function) {
  if (!process().current)
    report_outside(RiError::kNotStarted, fmt::format("{}: RiBegin is missing", function));
  return process().current;
}

Context::Context(std::unique_ptr<Backend> backend, Report report)
    : backend_(std::move(backend)), report_(std::move(report)) {
  backend_->set_report(report_);
  backend_->update(tracker_);
}

void set_rib_option_outside(const ParameterList& list) {
  CallBuilder builder(RequestId::kOption, {});
  builder.add("rib");
  builder.params(list, SizeTracker(),
                 [](const CallProblem& p) { report_outside(p.kind, "Option: " + p.text); });
  std::string problem = builder.problem().text.empty() ? set_rib_option(builder.call(), process().output)
                                                       : builder.problem().text;
  if (!problem.empty()) report_outside(RiError::kRange, "Option: " + problem);
}

bool Context::parameters(CallBuilder& builder, const ParameterList& list) {
  std::string name = fmt::format("Ri{}", builder.call().info().name);
  builder.params(list, tracker_, [&](const CallProblem& p) { error(name, p.kind, p.text); });
  if (builder.problem().text.empty()) return true;
  error(name, builder.problem().kind, builder.problem().text);
  return false;
}

bool Context::finish(CallBuilder& builder, const ParameterList& list) {
  if (!parameters(builder, list)) return false;
  const RequestCall& call = builder.call();
  tracker_.request(call);
  backend_->request(call);
  if (call.id == RequestId::kArchiveInstance) backend_->update(tracker_);
  return true;
}

void Context::read_archive(RtToken name, RtArchiveCallback callback, const ParameterList& list) {
  CallBuilder builder(RequestId::kReadArchive, where_);
  builder.add(name);
  if (!parameters(builder, list)) return;
  std::function<void(std::string_view)> on_comment;
  if (callback)
    on_comment = [callback](std::string_view text) {
      bool structure = text.starts_with('#');
      std::string rest(text.substr(structure ? 1 : 0));
      std::array<char, 3> format{"%s"};
      callback(structure ? RI_STRUCTURE : RI_COMMENT, format.data(), rest.c_str());
    };
  backend_->read_archive(builder.call(), on_comment);
  backend_->update(tracker_);
}

void Context::archive_record(std::string_view type, const std::string& text) {
  if (type == "comment") {
    backend_->comment(text);
  } else if (type == "structure") {
    backend_->comment("#" + text);
  } else if (type == "verbatim") {
    backend_->verbatim(text);
    backend_->update(tracker_);
  } else {
    error("RiArchiveRecord", RiError::kBadToken,
          fmt::format("unknown type \"{}\"; known are comment, structure, verbatim", type));
  }
}

void Context::procedural(RtPointer data, RtBound bound, RtProcSubdivFunc subdivfunc,
                         RtProcFreeFunc freefunc) {
  if (!bound || !subdivfunc) {
    error("RiProcedural", RiError::kMissingData,
          bound ? "'subdivfunc' is a null pointer" : "'bound' is a null pointer");
    return;
  }
  auto [type, count] = procedural_type(subdivfunc);
  if (!type) {
    auto maker = std::make_shared<FunctionGeometry>(*this, where_, data, subdivfunc, freefunc);
    backend_->procedural(std::span<const float, 6>(bound, 6), std::move(maker), where_);
    return;
  }
  send(RequestId::kProcedural, {}, type, Texts{static_cast<const RtString*>(data), count}, Floats{bound, 6});
  if (freefunc) freefunc(data);
}

void Context::pixel_filter(RtFilterFunc function, RtFloat xwidth, RtFloat ywidth) {
  if (function && filter_name(function).empty())
    backend_->pixel_filter(function, xwidth, ywidth);
  else
    send(RequestId::kPixelFilter, {}, Filter{function}, xwidth, ywidth);
}

bool Context::transform_points(RtToken from, RtToken to, RtInt n, RtPoint points[]) {
  constexpr const char* kName = "RiTransformPoints";
  if (!from || !to || (n > 0 && !points)) {
    error(kName, RiError::kMissingData, "a null pointer");
    return false;
  }
  auto there = backend_->to_camera(from), back = backend_->to_camera(to);
  for (const auto* m : {&there, &back})
    if (!*m) {
      error(kName, RiError::kBadToken, m->error());
      return false;
    }
  Matrix4 m = *there * inverse_or_identity(*back);
  for (RtInt i = 0; i < n; ++i) {
    Vec3 p = transform_point(m, Vec3(points[i][0], points[i][1], points[i][2]));
    std::copy_n(&p.x, 3, points[i]);
  }
  return true;
}

void Context::run(slvm::SourceRange where, const std::function<void()>& functions) {
  std::scoped_lock lock(process().functions);
  Context* outer = set_current(this);
  SizeTracker tracker = tracker_;
  backend_->update(tracker_);
  auto outer_where = std::exchange(where_, where);
  ++running_;
  functions();
  --running_;
  where_ = outer_where;
  tracker_ = std::move(tracker);
  set_current(outer);
}

void Context::finish() {
  backend_->finish();
}

} // namespace render::ri

using render::RiError;
using render::ri::call_handler;
using render::ri::Context;
using render::ri::process;

extern "C" {

RtVoid RiErrorHandler(RtErrorHandler handler) {
  if (!handler) handler = RiErrorIgnore;
  Context* context = render::ri::current();
  (context ? context->handler : process().handler) = handler;
  if (context) context->backend().error_handler(handler);
}

RtVoid RiBegin(RtToken name) {
  using namespace render::ri;
  // An existing program becomes one that writes RIB by its environment.
  const char* instead = std::getenv("ANEMONE_RIB");
  std::string text = name && *name ? name : instead ? instead : "";
  if (current() && current()->is_running()) {
    current()->error("RiBegin", RiError::kNesting, "functions of a procedural cannot begin a renderer");
    return;
  }
  if (text.starts_with('|')) {
    report_outside(RiError::kIncapable, fmt::format("RiBegin: \"{}\" is a program to be run, which is not "
                                                    "done; RiBegin(RI_NULL) renders here, a file name writes "
                                                    "RIB",
                                                    text));
    return;
  }
  // Made in two steps: what a renderer reports needs the context, which needs the renderer.
  auto slot = std::make_shared<Context*>(nullptr);
  std::unique_ptr<Backend> backend;
  if (text.empty())
    backend = make_render_backend([slot](slvm::SourceRange where, const std::function<void()>& functions) {
      (*slot)->run(where, functions);
    });
  else
    backend = std::make_unique<RibBackend>(rib_output(text));
  auto report = [slot](RiError kind, RtInt severity, const std::string& message) {
    call_handler(*slot ? (*slot)->handler : process().handler, kind, severity, message);
  };
  auto context = std::make_unique<Context>(std::move(backend), report);
  context->handler = process().handler;
  *slot = context.get();
  set_current(context.get());
  process().contexts.push_back(std::move(context));
}

RtVoid RiEnd(void) {
  Context* context = render::ri::current("RiEnd");
  if (!context) return;
  auto& all = process().contexts;
  auto it = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.get() == context; });
  if (context->is_running() || it == all.end()) {
    context->error("RiEnd", RiError::kNesting, "functions of a procedural cannot end the renderer");
    return;
  }
  context->finish();
  render::ri::set_current(nullptr);
  all.erase(it);
}

RtContextHandle RiGetContext(void) {
  return render::ri::current();
}

RtVoid RiContext(RtContextHandle handle) {
  Context* context = render::ri::current();
  if (context && context->is_running()) {
    context->error("RiContext", RiError::kNesting, "functions of a procedural cannot change the context");
    return;
  }
  auto& all = process().contexts;
  auto it = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.get() == handle; });
  if (!handle || it != all.end())
    render::ri::set_current(handle ? it->get() : nullptr);
  else
    render::ri::report_outside(RiError::kBadHandle, "RiContext: this is no context, or it was ended");
}

} // extern "C"

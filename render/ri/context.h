// The state behind the C functions: contexts (RiBegin ... RiEnd), which one is current, and where errors go.
// All of it hangs on one object that ri.h, being C, has no way to pass around.
#pragma once

#include "render/ri/backend.h"
#include "render/ri/call_builder.h"

#include <fmt/format.h>

#include <exception>
#include <new>

namespace render::ri {

class Context {
public:
  /// `report` gets every message.
  Context(std::unique_ptr<Backend> backend, Report report);

  /// One request, made of its arguments in order and a parameter list. False: it had a problem, which was
  /// reported.
  template <class... Args> bool send(RequestId id, const ParameterList& list, const Args&... args) {
    try {
      CallBuilder builder(id, where_);
      (builder.add(args), ...);
      return finish(builder, list);
    } catch (const std::bad_alloc&) {
      report(RiError::kNoMemory, RIE_SEVERE, "out of memory; a request is skipped");
    } catch (const std::exception& e) {
      report(RiError::kBug, RIE_SEVERE, fmt::format("internal error: {}", e.what()));
    }
    return false;
  }

  void read_archive(RtToken name, RtArchiveCallback callback, const ParameterList& list);
  void archive_record(std::string_view type, const std::string& text);
  void procedural(RtPointer data, RtBound bound, RtProcSubdivFunc subdivfunc, RtProcFreeFunc freefunc);
  void pixel_filter(RtFilterFunc function, RtFloat xwidth, RtFloat ywidth);
  bool transform_points(RtToken from, RtToken to, RtInt n, RtPoint points[]);
  void finish();

  /// Handles of lights and objects: 1, 2, 3...
  RtPointer next_light() { return number(++lights_); }
  RtPointer next_object() { return number(++objects_); }
  bool is_light(RtPointer handle) const { return reinterpret_cast<uintptr_t>(handle) - 1 < lights_; }
  bool is_object(RtPointer handle) const { return reinterpret_cast<uintptr_t>(handle) - 1 < objects_; }

  void report(RiError kind, RtInt severity, const std::string& text) { report_(kind, severity, text); }
  void error(std::string_view function, RiError kind, std::string_view text) {
    report(kind, RIE_ERROR, fmt::format("{}: {}", function, text));
  }

  /// Carries out functions of the program (or a plug-in) that make requests: this context is the current one
  /// meanwhile, and errors point at `where`.
  void run(slvm::SourceRange where, const std::function<void()>& functions);
  bool is_running() const { return running_ > 0; }
  slvm::SourceRange where() const { return where_; }
  Backend& backend() { return *backend_; }

  RtErrorHandler handler = nullptr; ///< null: messages are the backend's business
  std::string archive;              ///< name of the archive that is being recorded

private:
  static RtPointer number(uintptr_t n) { return reinterpret_cast<RtPointer>(n); }
  bool finish(CallBuilder& builder, const ParameterList& list);
  bool parameters(CallBuilder& builder, const ParameterList& list);

  std::unique_ptr<Backend> backend_;
  Report report_;
  SizeTracker tracker_;
  slvm::SourceRange where_; ///< of the procedural whose functions run
  uintptr_t lights_ = 0, objects_ = 0;
  int running_ = 0;
};

/// The current context, or null after an error that names `function`.
Context* current(const char* function);
/// The same without an error.
Context* current();
Context* set_current(Context* context);
/// Sets RiLastError, and calls the handler.
void call_handler(RtErrorHandler handler, RiError kind, RtInt severity, const std::string& text);
/// Removes what contexts have written so far: the program is about to end.
void abandon_files();
/// Option "rib" before RiBegin.
void set_rib_option_outside(const ParameterList& list);
/// To the handler that counts outside of contexts.
void report_outside(RiError kind, const std::string& text);

} // namespace render::ri

#include "slvm/exec/plugin_host.h"

#include "slvm/exec/plugin_call.h"
#include "slvm/exec/run.h"
#include "slvm/support/crash_guard.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace slvm {
namespace {

using VoidFunction = RslVoidFunc;
using PointInit = void* (*)(int, void*);
using PointShutdown = void (*)(void*);
using Enter = void (*)(const AnemonePluginServices*, void*);

// The same types, as far as both can tell; what the function stores to, the call must expect.
bool same_function(const PluginShadeop& called, const PluginShadeop& declared) {
  const Signature &a = called.info().signature, &b = declared.info().signature;
  if (a.result != b.result || a.uniform_result != b.uniform_result || a.param_count != b.param_count ||
      ((called.info().flags ^ declared.info().flags) & kHiddenVarying))
    return false;
  for (int i = 0; i < a.param_count; ++i) {
    const SignatureParam &p = a.param(i), &q = b.param(i);
    if (p.type != q.type || p.array != q.array || p.elements != q.elements || p.uniform != q.uniform ||
        (q.output && !p.output))
      return false;
  }
  return true;
}

std::string one_line(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts)
    all += "; " + text;
  return all;
}

} // namespace

PluginContext::PluginContext(PluginHost& host, PluginThread* thread)
    : increments(16), host_(host), thread_(thread),
      messages_([this](PluginMessage m) { tell(std::move(m)); }) {}

RixInterface* PluginContext::GetRixInterface(RixInterfaceId id) const {
  switch (id) {
  case k_RixGlobalData: return &host_.globals();
  case k_RixThreadData: return thread_ ? &thread_->storage() : nullptr;
  case k_RixLocalData: return thread_ ? &thread_->locals() : nullptr;
  case k_RixMessages: return &messages_;
  case k_RixStats: return &host_.statistics();
  case k_RixThreadUtils: return &host_.thread_utils();
  case k_RixGlobalTokenData: return &host_.tokens();
  case k_RixRunData: return &host_.run_data();
  case k_RixGrid: grid_.call = call; return call ? &grid_ : nullptr;
  default: return nullptr;
  }
}

const RslRunFlag* PluginContext::GetRunFlags(unsigned int* length) const {
  *length = static_cast<unsigned int>(flags.size());
  return flags.data();
}

bool PluginGrid::Size(int* columns, int* rows, int* piece_rows) const {
  const Grid& grid = *call->run.state.grid;
  const bool neighbours = grid.lattice != Lattice::kHits;
  *columns = neighbours ? grid.nu() : 0;
  *rows = neighbours ? grid.nv() : 0;
  *piece_rows = neighbours ? grid.rows_of_piece() : 0;
  return neighbours;
}

// In a call a message has its line.
void PluginContext::tell(PluginMessage message) const {
  std::string text = fmt::format("{}: {}", name, message.text);
  if (call && message.info) {
    text += '\n';
    call->run.state.services.print(call->run.shading_state(), text);
  } else if (call) {
    call->run.report(call->code, message.severity, std::move(text),
                     mask_count(call->run.mask.current(), call->run.points));
  } else {
    RuntimeMessage told;
    told.severity = message.severity;
    told.file = name;
    told.shader = "plug-in";
    told.text = std::move(text);
    host_.machine().report(told);
  }
}

// ---- The machine's part.

PluginHost::PluginHost(const Machine& machine, std::vector<std::string> folders)
    : machine_(machine), folders_(std::move(folders)), tokens_(machine.strings()), context_(*this, nullptr),
      globals_(context_), run_data_(context_) {}

PluginHost::~PluginHost() {
  end_frame();
  run_data_.clear(); // while libraries are open, whose functions clean up
}

void PluginHost::enter(const HostedLibrary& library, PluginContext* context) {
  if (void* function = library.library->enter())
    reinterpret_cast<Enter>(function)(&plugin_services(), context);
}

Result<HostedLibrary*> PluginHost::open(const PluginShadeop& wanted) {
  // Whatever folders the compiler found it in: only the user's count.
  const std::string file = std::filesystem::path(wanted.name().library).filename().string();
  const std::string path = find_library(file, folders_);
  if (path.empty())
    return Error{fmt::format("'{}' is a function of the plug-in '{}', which is not found: {}",
                             wanted.name().function, file, plugin_folders_advice(folders_))};
  std::unique_ptr<HostedLibrary>& known = libraries_[path];
  if (!known) {
    auto library = PluginLibrary::open(path);
    if (!library) {
      libraries_.erase(path);
      return Error{fmt::format("'{}' is a function of a plug-in that cannot be used: {}",
                               wanted.name().function, library.error())};
    }
    known = std::make_unique<HostedLibrary>();
    known->library = *library;
  }
  return known.get();
}

Result<HostedFunction*> PluginHost::bind(const PluginShadeop& wanted) {
  std::lock_guard lock(mutex_);
  auto library = open(wanted);
  if (!library) return Error{library.error()};
  HostedLibrary& home = **library;
  HostedFunction* function = nullptr;
  for (HostedFunction& f : functions_)
    if (f.home == &home && f.declared->name().function == wanted.name().function &&
        same_function(wanted, *f.declared))
      function = &f;
  if (!function) {
    std::vector<std::string> trouble;
    std::string others;
    for (PluginEntry& entry : home.library->functions(wanted.name().function, trouble)) {
      auto declared =
          PluginShadeop::make({entry.function, entry.signature, home.library->path(), entry.form});
      if (!declared) continue;
      others += (others.empty() ? "" : ", ") + entry.signature;
      if (function || entry.form != wanted.name().form || !same_function(wanted, *declared)) continue;
      function = &functions_.emplace_back();
      function->home = &home;
      function->entry = std::move(entry);
      function->declared = std::move(declared);
    }
    if (!function)
      return Error{
          fmt::format("the plug-in {} has no '{}' with signature '{}' ({}): compile the shader again{}",
                      home.library->path(), wanted.name().function, wanted.name().signature,
                      others.empty() ? "none of that name" : "but " + others, one_line(trouble))};
  }
  if (std::string error = prepare_locked(*function); !error.empty())
    return Error{fmt::format("'{}' of the plug-in {} cannot be called: {}", wanted.name().function,
                             home.library->path(), error)};
  return function;
}

std::string PluginHost::prepare(HostedFunction& function) {
  if (function.ready) return "";
  std::lock_guard lock(mutex_);
  return prepare_locked(function);
}

// The functions of libraries that take a context; "" or what went wrong.
std::string PluginHost::call_void(HostedLibrary& library, void* function, bool guarded) {
  if (std::string why = library.broken(); !function || !why.empty()) return why;
  context_.name = library.library->name();
  enter(library, &context_);
  auto call = [&] { reinterpret_cast<VoidFunction>(function)(&context_); };
  std::string error = guarded ? call_guarded(call) : call_catching(call);
  enter(library, nullptr);
  return error;
}

std::string PluginHost::prepare_locked(HostedFunction& function) {
  HostedLibrary& home = *function.home;
  if (std::string why = home.broken(); !why.empty()) return why;
  if (function.ready) return "";
  if (function.entry.form != PluginForm::kPointwise) {
    std::string error;
    if (!home.initialised) {
      error = call_void(home, home.library->library_init(), true);
      if (!error.empty()) return home.give_up("in the library's init " + error);
      home.initialised = true;
      initialised_.push_back(&home);
    }
    for (void* step : {function.entry.begin, function.entry.init})
      if (error = call_void(home, step, true); !error.empty()) return home.give_up("in its init " + error);
    prepared_.push_back(&function);
  }
  function.ready = true;
  return "";
}

std::string PluginHost::end_frame() {
  std::lock_guard lock(mutex_);
  std::string told = statistics_.take();
  globals_.clear();
  for (; !prepared_.empty(); prepared_.pop_back()) {
    HostedFunction& f = *prepared_.back();
    if (f.entry.init) call_void(*f.home, f.entry.shutdown, false);
    call_void(*f.home, f.entry.end, false);
  }
  for (; !initialised_.empty(); initialised_.pop_back()) {
    call_void(*initialised_.back(), initialised_.back()->library->library_cleanup(), false);
    initialised_.back()->initialised = false;
  }
  for (HostedFunction& f : functions_)
    f.ready = false;
  return told;
}

// ---- A thread's part.

PluginThread::PluginThread(PluginHost& host)
    : host_(host), number_(host.next_thread()), context_(host, this), storage_(context_), locals_(context_) {}

PluginThread::~PluginThread() {
  locals_.clear();
  for (; !inits_.empty(); inits_.pop_back()) {
    InitData& init = inits_.back();
    const PluginEntry& entry = init.function->entry;
    HostedLibrary& home = *init.function->home;
    if (!init.error.empty() || !entry.shutdown || !home.broken().empty()) continue;
    std::unique_lock turn(home.turn, std::defer_lock);
    if (!entry.thread_safe) turn.lock();
    context_.call = nullptr;
    PluginHost::enter(home, &context_);
    call_catching([&] { reinterpret_cast<PointShutdown>(entry.shutdown)(init.data); });
    PluginHost::enter(home, nullptr);
  }
  storage_.clear();
}

bool PluginThread::init_data(HostedFunction& function, void*& data, std::string& error) {
  HostedLibrary& home = *function.home;
  auto [it, is_new] = known_.try_emplace({&home, function.entry.shared}, inits_.size());
  if (is_new) {
    InitData& init = inits_.emplace_back();
    init.function = &function;
    if (function.entry.init) {
      init.error = call_guarded([&] {
        init.data = reinterpret_cast<PointInit>(function.entry.init)(static_cast<int>(number_), nullptr);
      });
      if (init.error.starts_with("it crashed")) home.give_up("in its init " + init.error);
    }
  }
  const InitData& init = inits_[it->second];
  data = init.data;
  error = init.error.empty() ? "" : "in its init " + init.error;
  return init.error.empty();
}

} // namespace slvm

// Plug-ins of a machine: libraries opened, functions bound, what is called when a frame begins and ends; and
// what each thread has of them. How a call is made: plugin_call.h.
//
// Order of calls: the library's init, a function's begin and init at its first binding in a frame; per thread
// the init of a function called by point before its first call. In the reverse order at the end of the thread
// (its ShadingContext) and of the frame (Machine::end_plugins, or the machine).
#pragma once

#include "slvm/exec/plugin_interfaces.h"
#include "slvm/plugin/library.h"
#include "slvm/plugin/sdk/rx.h"

#include <atomic>
#include <deque>

namespace slvm {

struct GridCall;
class Machine;
class PluginHost;
class PluginThread;

/// A library, and whether its functions have been prepared.
struct HostedLibrary {
  std::shared_ptr<const PluginLibrary> library;
  std::mutex turn; ///< held during calls of functions that are not thread-safe
  bool initialised = false;

  /// Why it is not called any more; "" as long as it is.
  std::string broken() const {
    std::lock_guard lock(state_);
    return broken_;
  }
  const std::string& give_up(std::string why) {
    std::lock_guard lock(state_);
    if (broken_.empty()) broken_ = std::move(why);
    return broken_;
  }

private:
  mutable std::mutex state_;
  std::string broken_;
};

/// A function that instances call.
struct HostedFunction {
  HostedLibrary* home = nullptr;
  PluginEntry entry;
  std::shared_ptr<const PluginShadeop> declared; ///< as its table has it
  std::atomic<bool> ready = false;               ///< its init has been called in this frame
};

/// The grid of a call.
class PluginGrid : public RixGrid {
public:
  bool Size(int* columns, int* rows, int* piece_rows) const override;
  const GridCall* call = nullptr;
};

/// What functions see of the program: of a call, or (`call` null) of init and cleanup.
class PluginContext : public RslContext {
public:
  PluginContext(PluginHost& host, PluginThread* thread);
  RixInterface* GetRixInterface(RixInterfaceId id) const override;
  const RslRunFlag* GetRunFlags(unsigned int* length) const override;
  const char* GetPluginName() const override { return name.c_str(); }

  const GridCall* call = nullptr;
  std::string name; ///< of the library whose code runs
  std::vector<RslRunFlag> flags;
  std::vector<RslIncrType> increments; ///< from each active point to the next, and zeros
  size_t first_active = 0;

private:
  const RslIncrType* steps() const override { return increments.data(); }
  void tell(PluginMessage message) const;

  PluginHost& host_;
  PluginThread* thread_;
  mutable PluginMessages messages_;
  mutable PluginGrid grid_;
};

class PluginHost {
public:
  PluginHost(const Machine& machine, std::vector<std::string> folders);
  ~PluginHost();

  /// The function behind an import, prepared. The error names the function, the library and the remedy.
  Result<HostedFunction*> bind(const PluginShadeop& wanted);
  /// Prepares it again in a new frame. "" or why it cannot be called.
  std::string prepare(HostedFunction& function);
  /// Ends the frame: cleanup functions, storage. No call may be under way. Returns what statistics plug-ins
  /// gave.
  std::string end_frame();

  const Machine& machine() const { return machine_; }
  uint32_t next_thread() { return threads_++; }
  /// Tells the library's header that `call` begins, or (null) ends.
  static void enter(const HostedLibrary& library, PluginContext* context);

  PluginContext& context() { return context_; }
  PluginStorage& globals() { return globals_; }
  PluginStorage& run_data() { return run_data_; }
  PluginTokens& tokens() { return tokens_; }
  PluginStatistics& statistics() { return statistics_; }
  PluginThreadUtils& thread_utils() { return thread_utils_; }

private:
  Result<HostedLibrary*> open(const PluginShadeop& wanted);
  std::string prepare_locked(HostedFunction& function);
  std::string call_void(HostedLibrary& library, void* function, bool guarded);

  const Machine& machine_;
  std::vector<std::string> folders_;
  PluginTokens tokens_;
  PluginStatistics statistics_;
  PluginThreadUtils thread_utils_;
  PluginContext context_;
  PluginStorage globals_, run_data_; // of the frame, and of the host's life
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<HostedLibrary>> libraries_; // by path
  std::deque<HostedFunction> functions_;
  std::vector<HostedLibrary*> initialised_; // in order
  std::vector<HostedFunction*> prepared_;   // in order
  std::atomic<uint32_t> threads_ = 0;
};

/// An argument of a call by grid; its memory is used again.
class PluginArgument;

/// What a thread, one ShadingContext, has of the plug-ins.
class PluginThread {
public:
  explicit PluginThread(PluginHost& host);
  ~PluginThread();

  PluginHost& host() { return host_; }
  /// What the init of a function called by point returned in this thread, which is called now if it was not
  /// yet. The caller holds the library's turn where it is needed. False: it failed, `error` says how.
  bool init_data(HostedFunction& function, void*& data, std::string& error);
  /// The shaders of a grid have run.
  void end_grid() { locals_.clear(); }

  PluginContext& context() { return context_; }
  PluginStorage& storage() { return storage_; }
  PluginStorage& locals() { return locals_; }

  /// Of calls, used again.
  struct Memory {
    Memory();
    ~Memory();
    std::vector<std::unique_ptr<PluginArgument>> arguments;
  } memory;

private:
  struct InitData {
    HostedFunction* function = nullptr;
    void* data = nullptr;
    std::string error;
  };
  PluginHost& host_;
  uint32_t number_;
  PluginContext context_;
  PluginStorage storage_, locals_;
  std::map<std::pair<const HostedLibrary*, size_t>, size_t> known_; // index into inits_
  std::vector<InitData> inits_;                                     // in order
};

} // namespace slvm

// One run of a setup: the grid is built, shaders are loaded and bound on a machine of their own, the grid is
// shaded, results are copied out. prepare() does what all runs of a setup share, Binding what depends on the
// configuration, Worker one thread's work.
#pragma once

#include "slvm/machine.h"
#include "slvm/tools/sltest/grid_data.h"
#include "slvm/tools/sltest/library.h"
#include "slvm/tools/sltest/ray_scene.h"
#include "slvm/tools/sltest/services.h"
#include "slvm/tools/sltest/setup.h"

#include <memory>
#include <string>
#include <vector>

namespace slvm::sltest {

/// In which way to run. Results must not depend on any of it, but for rounding between targets and -O levels.
struct RunConfig {
  uint32_t strip = 128;
  int opt_level = 2;
  bool specialise = true;
  std::string target;                   ///< "": the best there is
  Instrumenter* instrumenter = nullptr; ///< marks sources, for observers of the run
  bool instrument_all = true;           ///< false: the shader under test only
  std::vector<std::string> plugin_folders = {};
};
/// "strips of 128, -O2, specialised".
std::string describe(const RunConfig&);

enum class Failure : uint8_t { kNone, kMissing, kSetup, kCompile, kBind };

/// Why a setup cannot run.
struct RunError {
  Failure failure = Failure::kNone;
  std::string text;
};

/// What all runs of a setup start from.
struct Prepared {
  ShaderKind kind = ShaderKind::kSurface;
  GridData grid;
  Scene scene;
};
bool prepare(const Setup& setup, ShaderLibrary& library, Prepared& prepared, RunError& error);

struct RunResult {
  std::vector<Variable> outputs; ///< in the order in which they are printed
  std::string printed;
  std::vector<RuntimeMessage> messages;
  std::vector<std::string> warnings; ///< of the compiler, about the shader under test

  const Variable* find(std::string_view name) const;
};

/// The shaders of a setup, bound on a machine. Shared by workers.
class Binding {
public:
  static std::unique_ptr<Binding> make(const Setup& setup, const Prepared& prepared, ShaderLibrary& library,
                                       const RunConfig& config, RunError& error);
  const Prepared& prepared() const { return *prepared_; }
  const Instance& main() const { return *main_; }
  const std::string& warnings() const { return warnings_; }
  /// Run-time messages of all workers so far.
  std::vector<RuntimeMessage> messages() const { return machine_.messages(); }

private:
  friend class Worker;
  explicit Binding(const MachineOptions& options) : machine_(options) {}
  std::unique_ptr<Instance> bind(const Setup&, const ShaderRef&, ShaderLibrary&, const RunConfig&, RunError&);
  bool set_scene(const Setup&, ShaderLibrary&, const RunConfig&, RunError&);

  Machine machine_;
  const Prepared* prepared_ = nullptr;
  std::unique_ptr<Instance> main_;
  std::vector<std::unique_ptr<Instance>> companions_, lights_;
  std::unique_ptr<RayScene> ray_scene_;
  ShaderSet set_;
  std::string warnings_;
  std::vector<std::string> main_warnings_;
};

/// Shades the grid of a binding; one for each thread.
class Worker {
public:
  explicit Worker(const Binding& binding);
  /// Fills the grid anew and shades it; returns the seconds shading took.
  double shade();
  /// From now on `observer` watches; null: nobody.
  void observe(ExecutionObserver* observer) { context_.observe(observer); }
  /// What the last shade() computed.
  RunResult result() const;

private:
  std::vector<std::string> output_names() const;

  const Binding& binding_;
  MemoryServices services_;
  ShadingContext context_;
  Grid grid_;
};

/// prepare, bind and shade at once.
bool run_once(const Setup& setup, const Prepared& prepared, ShaderLibrary& library, const RunConfig& config,
              RunResult& result, RunError& error);

} // namespace slvm::sltest

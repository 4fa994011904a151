// The virtual machine: load compiled shaders, bind parameter values, run them on grids, read what they
// computed. PUBLIC; the way in for renderers.
//
//   slvm::Machine machine;                                    // one for all threads
//   auto shader = machine.load_file("plastic.slo");           // verified; Result<std::shared_ptr<const
//   Shader>> auto plastic = machine.instantiate(*shader, {{"Kd", {...}}}, {}); slvm::ShadingContext
//   context(machine, services);          // one for each thread context.shade({.surface = plastic->get()},
//   grid);         // fills Ci, Oi grid.variable(slvm::Global::kCi).get(0, point);
#pragma once

#include "slvm/format/program.h"
#include "slvm/grid.h"
#include "slvm/light_emitter.h"
#include "slvm/renderer_services.h"
#include "slvm/support/result.h"
#include "slvm/support/string_pool.h"

#include <atomic>
#include <bitset>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace slvm {

class ExecutionObserver; // slvm/exec/observer.h
class PluginHost;        // slvm/exec/plugin_host.h
struct KernelTable;
namespace ir {
class ConstantEvaluator;
}

struct MachineOptions {
  /// Points a strip: how many are taken through a run of instructions at a time. A multiple of 16; results do
  /// not depend on it.
  uint32_t strip_points = 256;
  /// Instruction set by name ("AVX3", "AVX2", "SSE4", "EMU128"...); empty: the best this processor has.
  std::string target = {};
  /// Re-run the optimiser on each instance with its parameter values folded in.
  bool specialise = true;
  /// Rounds of all loops together that one run of a shader on one grid may take; then loops are left, with a
  /// run-time message. A shader that never ends would stop its renderer.
  uint64_t most_rounds = 30'000'000;
  /// Fill registers with signalling NaN before each run, so that a read of an unset value shows.
  bool poison_registers = false;
  /// Whether a shader that calls what this build cannot serve (the PENDING rows of shadeops.def) runs all the
  /// same: the call then gives 0, with a run-time message. Without it such a shader cannot be instantiated.
  bool zero_for_unserved = false;
  /// For an application's log: called with each run-time message when it first occurs, by the thread whose
  /// shader it is of, one call at a time. Repetitions, the same text from the same line of the same shader,
  /// are folded: Machine::messages() has their counts. It must not call the machine.
  std::function<void(const RuntimeMessage&)> on_message = {};
  /// Folders of plug-ins that shaders may call. They are native code: only what the user of the program named
  /// himself belongs here (slvm::plugin_folders in slvm/support/shared_library.h). Empty: none is loaded.
  std::vector<std::string> plugin_folders = {};
};

/// A compiled shader, loaded and verified. Immutable, shared between threads.
class Shader {
public:
  const Program& program() const { return program_; }
  const std::string& name() const { return program_.name; }
  ShaderKind kind() const { return program_.kind; }

private:
  friend class Machine;
  Program program_;
};

/// A parameter value as a scene gives it. Points, vectors, normals and matrices are in the shader's own
/// space.
struct ParamValue {
  std::string name;
  Value value;
};

struct InstanceOptions {
  /// "shader" to "current": the transformation at the scene's request for this shader.
  Matrix4 shader_to_current = {};
  /// Names of parameters that primitives may override by primitive variables: not folded in as constants.
  std::vector<std::string> may_vary = {};
  /// The surface of an area light; null: the light stands where its space does.
  std::shared_ptr<const LightEmitter> emitter = nullptr;
};

/// What a shader reads at points beside others: all that its derivatives depend on.
struct BesideReads {
  std::bitset<kGlobalCount> predefined;
  std::vector<std::string> parameters; ///< which primitive variables may stand for
};

/// A shader with parameter values: what a primitive, or the list of lights, refers to. Immutable.
class Instance {
public:
  ~Instance();
  const Shader& shader() const { return *shader_; }
  const Matrix4& shader_to_current() const { return shader_to_current_; }
  const Matrix4& current_to_shader() const { return current_to_shader_; } ///< 0 where there is no inverse
  /// The program that runs: the shader's own, or its specialisation for these values.
  const Program& program() const { return specialised_ ? *specialised_ : shader_->program(); }
  /// For lights: the names in __category, in order.
  std::span<const std::string> categories() const { return categories_; }

  /// Of area lights; else null.
  const LightEmitter* emitter() const { return emitter_.get(); }

  const BesideReads& reads_beside() const { return reads_beside_; }

  /// Differs between all instances of one machine.
  uint64_t id() const { return id_; }

  struct Bound; ///< the VM's own: parameter and constant planes, functions of imports (slvm/exec/bound.h)
  const Bound& bound() const { return *bound_; }

private:
  friend class Machine;
  Instance();
  uint64_t id_ = 0;
  std::shared_ptr<const Shader> shader_;
  std::unique_ptr<const Program> specialised_;
  Matrix4 shader_to_current_, current_to_shader_;
  std::vector<std::string> categories_;
  std::shared_ptr<const LightEmitter> emitter_;
  BesideReads reads_beside_;
  std::unique_ptr<Bound> bound_;
};

class Machine {
public:
  explicit Machine(MachineOptions options = {});
  ~Machine();

  /// Verifies and takes a compiled shader. The error says what is wrong with the file.
  Result<std::shared_ptr<const Shader>> load(std::span<const std::byte> slo) const;
  Result<std::shared_ptr<const Shader>> load_file(const std::string& path) const;

  /// Binds parameter values. Errors: an unknown parameter (with the nearest name), a wrong type or array
  /// length, a built-in function this build cannot serve, a plug-in that is missing or does not work.
  Result<std::unique_ptr<Instance>> instantiate(std::shared_ptr<const Shader>, std::span<const ParamValue>,
                                                const InstanceOptions& = {}) const;

  /// A light again, with no value folded into its code: all its parameters can be sent values while it runs.
  /// Fails where only the values kept it from a function this build cannot serve.
  Result<std::unique_ptr<Instance>> unspecialised(const Instance& light) const;

  /// A surface again, of which only these predefined variables and output parameters are wanted: what nothing
  /// else needs is not computed, with its lights and rays. Null: all of it is needed.
  std::unique_ptr<Instance> narrowed(const Instance& surface, std::span<const std::string> outputs) const;

  /// At the end of a frame, when no ShadingContext is left: plug-ins clean up, and begin anew when they are
  /// called again. Returns what they have to say of themselves (RixStats), lines of text. The destructor does
  /// the same.
  std::string end_plugins() const;

  const MachineOptions& options() const { return options_; }
  StringPool& strings() const { return strings_; }
  const KernelTable& kernels() const { return *kernels_; }
  PluginHost& plugins() const { return *plugins_; }

  /// Run-time messages so far, each once with its counts, in order of file and line.
  std::vector<RuntimeMessage> messages() const;
  void report(const RuntimeMessage&) const;
  /// Different messages kept; more are dropped.
  static constexpr size_t kMaxMessages = 1000;

private:
  struct Making; ///< machine.cpp
  Result<std::unique_ptr<Instance>> make(const Making&) const;

  MachineOptions options_;
  const KernelTable* kernels_;
  std::unique_ptr<ir::ConstantEvaluator> evaluator_;
  mutable std::atomic<uint64_t> instances_{0};
  mutable StringPool strings_;
  mutable std::mutex messages_mutex_;
  mutable std::vector<RuntimeMessage> messages_;
  std::unique_ptr<PluginHost> plugins_; // last: it reports when it goes
};

/// Runs instances on grids: registers, masks, light results. One for each thread; not thread-safe.
class ShadingContext {
public:
  ShadingContext(const Machine&, RendererServices&);
  ~ShadingContext();

  /// Runs displacement, surface and atmosphere, those that are there, in this order, with message passing
  /// between them. Ci and Oi start as Cs and Os (all 1 when these are not set). Missing input variables have
  /// defaults.
  void shade(const ShaderSet&, Grid&);
  /// Only the displacement shader: moves P, and N if it sets it.
  void displace(const ShaderSet&, Grid&);
  /// The rest of shade(), after displace() on the same grid.
  void shade_displaced(const ShaderSet&, Grid&);
  /// The two halves of that, the second one on the same grid.
  void shade_surface(const ShaderSet&, Grid&);
  void shade_atmosphere();
  /// Instead of the atmosphere: any volume shaders that change Ci and Oi in turn, and the end of the grid.
  void shade_volume(const Instance&);
  void end_grid();
  /// One shader of any kind by itself (imagers; lights in tests: set Ps, read Cl and L). Area lights shine
  /// from where u and v say, as LightEmitter::place() takes x and y, and undivided.
  void run(const Instance&, Grid&);

  /// From now on `observer` is told of each instruction that runs (slvm/exec/observer.h); null: nobody is,
  /// which costs nothing.
  void observe(ExecutionObserver* observer);

  /// Values of an output parameter after the run; valid until the next one. Null: no such parameter.
  const Planes* output(const Instance&, std::string_view name) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace slvm

// One shader instance running on one grid: its registers, its external variables, its masks. Lights run
// inside the run of the surface they light, each as a run of its own. Read next: interpreter.cpp.
#pragma once

#include "slvm/exec/bound.h"
#include "slvm/exec/lights.h"
#include "slvm/exec/mask_stack.h"
#include "slvm/exec/rays/gather_stack.h"
#include "slvm/kernels/table.h"
#include "slvm/machine.h"

#include <map>

namespace slvm {

class PluginThread; // slvm/exec/plugin_host.h

/// What the runs of one context share, and the grid they are on.
struct GridState {
  const Machine& machine;
  RendererServices& services;
  LightCache& lights;
  LightKernels light_kernels;
  Grid* grid = nullptr;
  const ShaderSet* shaders = nullptr;
  /// Runs of this grid's shaders so far, for message passing. Null: not run (yet).
  const ShaderRun* displacement = nullptr;
  const ShaderRun* surface = nullptr;
  const ShaderRun* atmosphere = nullptr;
  const ShaderRun* interior = nullptr; ///< these two run at hits of rays only; else their parameters count
  const ShaderRun* exterior = nullptr;
  ExecutionObserver* observer = nullptr; ///< told of each instruction; null: nobody
  PluginThread* plugins = nullptr;       ///< what this thread has of plug-ins
};

/// Where operands are, for the lanes being run: a strip, or the whole grid.
struct Frame {
  float* data[4]; ///< constants, uniform, strip and grid registers (of the first lane)
  size_t pitch[4];
  uint32_t step[4];
  size_t first = 0;  ///< grid index of the first lane
  size_t lanes = 0;  ///< a multiple of kMaxLanes
  size_t active = 0; ///< lanes that are points; the rest is padding
  /// In strips: operands by word of code, found before the block runs. Null at grid level.
  const Operand* resolved = nullptr;
  bool may_narrow = false; ///< false where derivatives read lanes that are off
  bool runs_idle = false;  ///< a strip that derivatives read: goes on with no lane on
  /// The lanes worth computing: all active ones are among [context.begin, end).
  size_t end = 0;
  KernelContext context;
};

class ShaderRun {
public:
  /// `outer`: the run whose light loop this light runs for, or null.
  ShaderRun(GridState& state, const Instance& instance, const ShaderRun* outer = nullptr);

  /// Takes memory for the grid of `state` and binds external variables; may be called again for the next
  /// grid. `position` and `normal`: Ps and Ns of lights.
  /// `sent`: their parameters that are not the instance's.
  void prepare(const Operand* position = nullptr, const Operand* normal = nullptr,
               std::span<const SentValue> sent = {});
  /// Computes defaults of parameters that are no constants.
  void compute_defaults();
  /// Does that, then runs the shader.
  void execute();

  GridState& state;
  const Instance& instance;
  const ShaderRun* outer;
  const Program& program;
  const Instance::Bound& bound;
  const Grid* on_emitter =
      nullptr;                  ///< of area lights: the points of their surfaces, for this sample; else null
  uint64_t emitter_seed = 0;    ///< of what is random in them; else Grid::id counts
  size_t points = 0, pitch = 0; ///< of the grid; points fewer when neighbours of hits are left out

  std::vector<Planes> slots; ///< by slot of the program
  MaskStack mask;            ///< of the whole grid
  LightLoop light_loop;      ///< the light loop being run (surfaces)
  std::vector<Emission>
      emissions; ///< what illuminate and solar gave so far (lights): the first emission_count
  size_t emission_count = 0;
  PlaneMemory cone_memory; ///< scratch of illuminate
  /// The block of a light being run, which decides what L is.
  enum class Emitting : uint8_t { kNothing, kIlluminate, kSolar };
  Emitting emitting = Emitting::kNothing;
  GatherStack gathers; ///< the loops over rays being run

  Operand operand(const Frame& f, uint32_t word) const {
    Operand out;
    resolve(f, word, out);
    return out;
  }
  /// The same in place. Members are written one by one: a copy of what was just written so waits for memory.
  void resolve(const Frame& f, uint32_t word, Operand& out) const {
    auto space = static_cast<size_t>(operand_space(word));
    if (space >= static_cast<size_t>(Space::kSlot)) return resolve_external(f, word, out);
    out.data = f.data[space] + operand_index(word) * f.pitch[space];
    out.pitch = f.pitch[space];
    out.step = f.step[space];
    out.elements = 1;
  }
  /// The operand whose word is at `w` in the code.
  Operand operand_at(const Frame& f, const uint32_t* w) const {
    return f.resolved ? f.resolved[w - program.code.data()] : operand(f, *w);
  }
  /// A variable or an array.
  void resolve_external(const Frame& frame, uint32_t word, Operand& out) const;
  const Frame& grid_frame() const { return frame_; }
  Planes* slot(Global g) {
    int32_t i = bound.slot_of[static_cast<size_t>(g)];
    return i < 0 ? nullptr : &slots[static_cast<size_t>(i)];
  }
  /// What is random in the run starts from this.
  uint64_t random_seed() const { return on_emitter ? emitter_seed : state.grid->id; }
  /// What a predefined variable is at the beginning, for functions that read it unasked.
  const Planes& variable(Global g);
  /// The planes of parameter `name`, or null.
  const Planes* parameter(std::string_view name) const;

  /// A run-time message at a word of code, for `count` points.
  void report(uint32_t code, MessageSeverity severity, std::string text, size_t count) const;
  ShadingState shading_state() const { return {*state.grid, *state.shaders, instance}; }

private:
  void bind_registers();
  Planes bind_parameter(size_t slot);
  /// What overrides the parameter of a slot, a primitive variable or a sent value, or null.
  const Planes* override_for(size_t slot) const;
  Planes bind_variable(Global g, bool stored, const Operand* position, const Operand* normal);
  Planes default_variable(Global g);
  /// A predefined variable as the renderer gives it: of an area light, on its surface; data null: not set.
  const Planes& given(Global g) const;
  Planes lattice(Global g);
  Planes take_uniform(Type type, std::initializer_list<float> value);
  Planes take_copy(const Slot& slot, const Planes& from);
  float* take(size_t floats);

  // The interpreter proper (interpreter.cpp).
  void run_code(Frame& frame, uint32_t pc);
  template <bool kObserved> void execute_code(Frame& frame, MaskStack& mask, uint32_t pc);
  template <bool kObserved>
  void run_strips(const Frame& grid, const MaskStack& grid_mask, uint32_t body, uint32_t end, bool all);
  void call(const Frame& frame, uint32_t pc, uint16_t import, std::span<const uint32_t> words);
  void shoot_from_samples(const GridCall& call, GridOp op);
  void leave_neighbours(Frame& frame, MaskStack& mask, uint32_t pc);
  void copy_planes(const Frame& frame, const MaskStack& mask, std::span<const uint32_t> words, bool masked);
  void first_active(const Frame& frame, const MaskStack& mask, std::span<const uint32_t> words);
  void array_load(const Frame& frame, const MaskStack& mask, uint32_t pc, std::span<const uint32_t> words);
  void array_store(const Frame& frame, const MaskStack& mask, uint32_t pc, std::span<const uint32_t> words);
  void call_kernel(const Frame& frame, Kernel kernel, const Operand* operands, uint32_t count) const {
    if (operands->step) {
      kernel(operands, count, frame.end, frame.context);
    } else { // a uniform call
      KernelContext context = frame.context;
      context.begin = 0;
      kernel(operands, count, kMaxLanes, context);
    }
  }
  const MaskWord* condition(const Frame& frame, const uint32_t* word);
  static void narrow(Frame& frame, const MaskStack& mask);
  uint32_t next_light(MaskStack& mask, uint32_t body, uint32_t end);
  uint32_t next_ray(const Frame& frame, MaskStack& mask, uint32_t body, uint32_t end);

  /// The lanes still in a loop go on to the next round; false: there are none, or they have gone round for
  /// too long.
  bool next_round(const Frame& frame, MaskStack& mask, uint32_t pc);
  /// Counts a round of those most_rounds allows. False, with a message: there are no more, and the loop must
  /// be left.
  bool take_round(uint32_t pc, size_t lanes);

  Frame frame_{};
  bool in_body_ = false; ///< the shader itself runs, not a default
  uint64_t rounds_left_ = 0;
  std::span<const SentValue> sent_;
  PlaneMemory memory_;
  std::vector<PlaneMemory> extra_; ///< variables with no place in the register memory
  size_t extra_used_ = 0;
  std::map<Global, Planes> unset_; ///< what variable() made so far
  std::vector<Operand> operands_;  ///< of a call at grid level
  std::vector<Operand> resolved_;  ///< by word of code: operands in strip blocks
  std::vector<CallOperand> decoded_;
  std::vector<GridOperand> grid_operands_;
  std::vector<MaskWord> condition_, lit_, entered_;
  MaskStack strip_mask_;
};

/// "float", "color[3]"...
std::string describe(Type type, uint32_t elements);

} // namespace slvm

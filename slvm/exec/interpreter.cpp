// The dispatch loop. Grid level and strip blocks run the same code; they differ in the frame (where operands
// are, how many lanes) and in whose mask stack control flow works on. It is compiled twice: with an observer
// told of each instruction, and without.
#include "slvm/exec/observer.h"
#include "slvm/exec/plugin_call.h"
#include "slvm/exec/rays/gather.h"
#include "slvm/exec/run.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace slvm {

void ShaderRun::resolve_external(const Frame& f, uint32_t word, Operand& out) const {
  uint32_t index = operand_index(word);
  if (operand_space(word) == Space::kSlot) {
    const Planes& p = slots[index];
    out.data = p.data + (p.step ? f.first : 0);
    out.pitch = p.pitch;
    out.step = p.step;
    out.elements = std::max(p.elements, 1u);
    return;
  }
  const ArrayInfo& a = program.arrays[index];
  resolve(f, make_operand(a.space, a.index), out);
  out.elements = a.elements;
}

const MaskWord* ShaderRun::condition(const Frame& f, const uint32_t* word) {
  Operand b = operand_at(f, word);
  condition_.resize(mask_words(f.lanes));
  if (b.step) {
    state.machine.kernels().mask_of_bools(condition_.data(), b.data, f.lanes);
  } else {
    bool holds = std::bit_cast<uint32_t>(b.data[0]) != 0;
    std::fill(condition_.begin(), condition_.end(), holds ? ~MaskWord{0} : MaskWord{0});
  }
  return condition_.data();
}

void ShaderRun::copy_planes(const Frame& f, const MaskStack& m, std::span<const uint32_t> w, bool masked) {
  Operand to = operand_at(f, &w[1]), from = operand_at(f, &w[2]);
  size_t lanes = to.step ? f.lanes : kMaxLanes;
  for (uint32_t i = 0; i < w[0]; ++i) {
    float *d = to.plane(i), *s = from.plane(i);
    if (masked && !m.all())
      state.machine.kernels().blend(d, s, from.step, m.current(), f.lanes);
    else if (from.step || !to.step)
      std::memcpy(d, s, lanes * sizeof(float));
    else
      std::fill_n(d, lanes, *s);
  }
}

void ShaderRun::first_active(const Frame& f, const MaskStack& m, std::span<const uint32_t> w) {
  Operand to = operand_at(f, &w[1]), from = operand_at(f, &w[2]);
  size_t lane = 0;
  for (size_t i = m.words(); i-- > 0;)
    if (m.current()[i]) lane = i * kMaskWordLanes + static_cast<size_t>(std::countr_zero(m.current()[i]));
  for (uint32_t i = 0; i < w[0]; ++i)
    std::fill_n(to.plane(i), kMaxLanes, from.plane(i)[from.step ? lane : 0]);
}

namespace {

// The element a subscript names, or -1. RSL truncates subscripts.
int64_t element_index(float subscript, uint32_t elements) {
  float truncated = std::trunc(subscript);
  return truncated >= 0 && truncated < static_cast<float>(elements) ? static_cast<int64_t>(truncated) : -1;
}

std::string subscript_error(float subscript, uint32_t elements) {
  char text[96];
  std::snprintf(text, sizeof text, "array subscript %g is outside 0..%u", static_cast<double>(subscript),
                elements - 1);
  return text;
}

} // namespace

void ShaderRun::array_load(const Frame& f, const MaskStack& m, uint32_t pc, std::span<const uint32_t> w) {
  Operand to = operand_at(f, &w[1]), array = operand_at(f, &w[2]), subscript = operand_at(f, &w[3]);
  size_t planes = w[0], lanes = to.step ? f.lanes : 1;
  size_t bad = 0, bad_lane = 0;
  for (size_t lane = 0; lane < lanes; ++lane) {
    int64_t e = element_index(subscript.data[subscript.step * lane], array.elements);
    bool active = !to.step || mask_test(m.current(), lane);
    if (e < 0 && active && bad++ == 0) bad_lane = lane;
    for (size_t i = 0; i < planes; ++i)
      to.plane(i)[lane] = e < 0 ? 0 : array.plane(static_cast<size_t>(e) * planes + i)[array.step * lane];
  }
  if (!to.step)
    for (size_t i = 0; i < planes; ++i)
      std::fill_n(to.plane(i), kMaxLanes, to.plane(i)[0]);
  if (bad)
    report(pc, MessageSeverity::kError,
           subscript_error(subscript.data[subscript.step * bad_lane], array.elements), bad);
}

void ShaderRun::array_store(const Frame& f, const MaskStack& m, uint32_t pc, std::span<const uint32_t> w) {
  Operand array = operand_at(f, &w[1]), subscript = operand_at(f, &w[2]), from = operand_at(f, &w[3]);
  size_t planes = w[0], lanes = array.step ? f.lanes : 1;
  size_t bad = 0, bad_lane = 0;
  for (size_t lane = 0; lane < lanes; ++lane) {
    if (array.step && !mask_test(m.current(), lane)) continue;
    int64_t e = element_index(subscript.data[subscript.step * lane], array.elements);
    if (e < 0) {
      if (bad++ == 0) bad_lane = lane;
      continue;
    }
    for (size_t i = 0; i < planes; ++i) {
      float* element = array.plane(static_cast<size_t>(e) * planes + i);
      float value = from.plane(i)[from.step * lane];
      if (array.step)
        element[lane] = value;
      else
        std::fill_n(element, kMaxLanes, value);
    }
  }
  if (bad)
    report(pc, MessageSeverity::kError,
           subscript_error(subscript.data[subscript.step * bad_lane], array.elements), bad);
}

// Calls that execute_code() does not make itself.
void ShaderRun::call(const Frame& f, uint32_t pc, uint16_t import, std::span<const uint32_t> words) {
  const Instance::Bound::Import& target = bound.imports[import];
  if (target.kernel) {
    for (size_t i = 0; i < words.size(); ++i)
      resolve(f, words[i], operands_[i]);
    call_kernel(f, target.kernel, operands_.data(), static_cast<uint32_t>(words.size()));
    return;
  }
  const ShadeopInfo& info = program.plugins.info(program.imports[import]);
  uint32_t level = 0;
  decode_call(info, words, decoded_, level);
  grid_operands_.clear();
  for (const CallOperand& o : decoded_)
    grid_operands_.push_back({operand(f, o.word), o.type, operand_space(o.word) == Space::kArray, o.store});
  const GridCall grid_call{*this, info, grid_operands_, level, pc};
  if (target.plugin)
    call_plugin(grid_call, *target.plugin);
  else if (info.flags & kRays && state.grid->samples() < points)
    shoot_from_samples(grid_call, target.grid_op);
  else
    target.grid_op(grid_call);
}

// Of hits, the points beside shoot no rays of their own: what those of the hit bring holds for them, too.
void ShaderRun::shoot_from_samples(const GridCall& call, GridOp op) {
  const size_t samples = state.grid->samples();
  entered_.assign(mask.words(), 0);
  for (size_t i = 0; i < entered_.size(); ++i)
    entered_[i] = full_mask_word(i, samples);
  mask.push_if(entered_.data());
  op(call);
  mask.pop_if();
  for (const GridOperand& o : call.operands) {
    if (!o.store || !o.planes.step) continue;
    const size_t planes = static_cast<size_t>(components(o.type)) * (o.array ? o.planes.elements : 1);
    for (size_t c = 0; c < planes; ++c)
      for (size_t i = samples; i < points; ++i)
        o.planes.plane(c)[i] = o.planes.plane(c)[i % samples];
  }
}

// Where nothing more is computed that derivatives look at, the points beside hits are done with, if nobody
// else wants them. A light is part of the surface it shines on.
void ShaderRun::leave_neighbours(Frame& f, MaskStack& m, uint32_t pc) {
  const size_t samples = state.grid->samples();
  if (!state.grid->neighbours_end || !in_body_ || points == samples || pc < bound.neighbours_end ||
      m.depth() > 0 || (outer && outer->points != samples))
    return;
  points = samples;
  f.active = samples;
  m.reset(pitch, samples);
}

void ShaderRun::run_code(Frame& frame, uint32_t pc) {
  if (state.observer)
    execute_code<true>(frame, mask, pc);
  else
    execute_code<false>(frame, mask, pc);
}

template <bool kObserved>
void ShaderRun::run_strips(const Frame& grid, const MaskStack& grid_mask, uint32_t body, uint32_t end,
                           bool all) {
  size_t strip = std::min<size_t>(state.machine.options().strip_points, pitch);
  const std::vector<uint32_t>& moving = bound.moving_operands;
  auto from = std::lower_bound(moving.begin(), moving.end(), body),
       to = std::lower_bound(from, moving.end(), end);
  Frame f = grid;
  f.may_narrow = !all;
  f.runs_idle = all;
  auto run = [&](size_t first, bool idle) {
    f.first = first;
    f.lanes = std::min(strip, pitch - first);
    f.active = std::min(f.lanes, points - first);
    f.data[static_cast<size_t>(Space::kGrid)] = grid.data[static_cast<size_t>(Space::kGrid)] + first;
    strip_mask_.reset_from(grid_mask, first, f.lanes, f.active);
    if (strip_mask_.any() == idle) return;
    for (auto word = from; word != to; ++word)
      resolve(f, program.code[*word], resolved_[*word]);
    f.resolved = resolved_.data();
    f.context.begin = 0;
    f.context.first_point = static_cast<uint32_t>(first);
    f.end = f.lanes;
    narrow(f, strip_mask_);
    execute_code<kObserved>(f, strip_mask_, body);
  };
  // Idle ones first: a uniform loop ends at once where no lane is on, and what it leaves in uniform registers
  // must be that of the others.
  for (size_t first = 0; first < points && all; first += strip)
    run(first, true);
  for (size_t first = 0; first < points; first += strip)
    run(first, false);
}

// Registers hold values for active lanes only, so that lanes before the first and after the last one can be
// left out.
void ShaderRun::narrow(Frame& f, const MaskStack& m) {
  if (!f.may_narrow) return;
  f.context.begin = 0;
  f.end = f.lanes;
  if (m.all() || !m.any()) return;
  size_t i = 0;
  while (!m.current()[i])
    ++i;
  f.context.begin =
      (i * kMaskWordLanes + static_cast<size_t>(std::countr_zero(m.current()[i]))) / kMaxLanes * kMaxLanes;
  i = m.words() - 1;
  while (!m.current()[i])
    --i;
  size_t last =
      i * kMaskWordLanes + kMaskWordLanes - 1 - static_cast<size_t>(std::countl_zero(m.current()[i]));
  f.end = (last / kMaxLanes + 1) * kMaxLanes;
}

bool ShaderRun::next_round(const Frame& f, MaskStack& m, uint32_t pc) {
  if (!m.next_round()) return false;
  if (take_round(pc, mask_count(m.current(), f.active))) return true;
  m.lanes_break(1);
  return m.next_round();
}

bool ShaderRun::take_round(uint32_t pc, size_t lanes) {
  if (rounds_left_ > 0) {
    --rounds_left_;
    return true;
  }
  report(
      pc, MessageSeverity::kError,
      fmt::format("a loop has not ended after {} rounds, and is left", state.machine.options().most_rounds),
      lanes);
  return false;
}

namespace {

/// Whether the rest of a region is left out, since no lane is on. Strips that derivatives read go on: other
/// lanes look at values of theirs. But not in a loop, which all lanes have left: another round must not
/// change what it leaves behind.
bool stops(const Frame& f, const MaskStack& m) {
  return !m.any() && (!f.runs_idle || m.within_loop());
}

} // namespace

template <bool kObserved> void ShaderRun::execute_code(Frame& f, MaskStack& m, uint32_t pc) {
  const uint32_t* code = program.code.data();
  const Instance::Bound::Import* imports = bound.imports.data();
  for (;;) {
    uint32_t at = pc;
    uint16_t opcode = instruction_opcode(code[at]);
    uint32_t count = instruction_words(code[at]);
    const uint32_t* w = code + at + 1;
    pc += 1 + count;
    if constexpr (kObserved)
      if (!state.observer->before({*this, f, m, at})) continue;
    if (opcode >= kFirstShadeop) {
      Kernel kernel = imports[opcode - kFirstShadeop].kernel;
      if (kernel && f.resolved) {
        call_kernel(f, kernel, f.resolved + (w - code), count);
      } else {
        if (!f.resolved) leave_neighbours(f, m, at);
        call(f, at, static_cast<uint16_t>(opcode - kFirstShadeop), {w, count});
      }
      if constexpr (kObserved) state.observer->after({*this, f, m, at});
      continue;
    }
    switch (static_cast<Opcode>(opcode)) {
    case Opcode::k_end:
    case Opcode::k_endstrip: return;
    case Opcode::k_strip:
      leave_neighbours(f, m, at);
      run_strips<kObserved>(f, m, pc, w[0], w[1] != 0);
      pc = w[0] + 1; // past the endstrip, which is one word
      break;
    case Opcode::k_mov: copy_planes(f, m, {w, count}, false); break;
    case Opcode::k_movm: copy_planes(f, m, {w, count}, true); break;
    case Opcode::k_first: first_active(f, m, {w, count}); break;
    case Opcode::k_astart: {
      Operand array = operand_at(f, w);
      const ArrayInfo& info = program.arrays[operand_index(w[0])];
      size_t planes = array.elements * static_cast<size_t>(components(info.type));
      for (size_t i = 0; i < planes; ++i)
        std::fill_n(array.plane(i), array.step ? f.lanes : kMaxLanes, 0.0f);
      break;
    }
    case Opcode::k_aload:
      array_load(f, m, at, {w, count});
      if constexpr (kObserved) state.observer->after({*this, f, m, at});
      break;
    case Opcode::k_astore: array_store(f, m, at, {w, count}); break;
    case Opcode::k_if:
      m.push_if(condition(f, w));
      if (!m.any()) pc = w[1];
      break;
    case Opcode::k_else:
      m.flip_else();
      if (!m.any()) pc = w[0];
      break;
    case Opcode::k_endif:
      m.pop_if();
      if (stops(f, m)) pc = w[0];
      break;
    case Opcode::k_uif:
      if (std::bit_cast<uint32_t>(*operand_at(f, w).data) == 0) pc = w[1] + 1 + instruction_words(code[w[1]]);
      break;
    case Opcode::k_uelse: pc = w[0]; break;
    case Opcode::k_uendif:
      if (stops(f, m)) pc = w[0];
      break;
    case Opcode::k_loop:
    case Opcode::k_block: m.push_loop(); break;
    case Opcode::k_endloop:
      if (next_round(f, m, at))
        pc = w[0];
      else if (stops(f, m))
        pc = w[1];
      break;
    case Opcode::k_endblock:
      m.pop_loop();
      if (stops(f, m)) pc = w[0];
      break;
    case Opcode::k_while:
    case Opcode::k_uwhile:
      m.lanes_where(condition(f, w));
      if (!m.any()) pc = w[1];
      break;
    case Opcode::k_break:
      m.lanes_break(w[0]);
      pc = w[1];
      break;
    case Opcode::k_continue:
      m.lanes_continue(w[0]);
      pc = w[1];
      break;
    case Opcode::k_illuminance: {
      leave_neighbours(f, m, at);
      Operand axis = operand_at(f, &w[4]), angle = operand_at(f, &w[5]);
      auto category = std::bit_cast<uint32_t>(*operand_at(f, &w[2]).data);
      m.push_loop();
      light_loop.begin(*this, state.machine.strings().text(category), operand_at(f, &w[3]),
                       w[1] ? &axis : nullptr, w[1] ? &angle : nullptr);
      pc = next_light(m, pc, w[0]);
      break;
    }
    case Opcode::k_endilluminance:
      // Lanes that broke out of all rounds leave nothing to light.
      pc = next_light(m, w[0], at);
      break;
    case Opcode::k_illuminate: {
      leave_neighbours(f, m, at);
      Operand axis = operand_at(f, &w[3]), angle = operand_at(f, &w[4]);
      begin_illuminate(*this, operand_at(f, &w[2]), w[1] ? &axis : nullptr, w[1] ? &angle : nullptr, lit_);
      m.push_if(lit_.data());
      entered_.assign(m.current(), m.current() + m.words());
      emitting = Emitting::kIlluminate;
      if (!m.any()) pc = w[0];
      break;
    }
    case Opcode::k_solar: {
      leave_neighbours(f, m, at);
      Operand axis = operand_at(f, &w[2]), angle = operand_at(f, &w[3]);
      begin_solar(*this, w[1] ? &axis : nullptr, w[1] ? &angle : nullptr, lit_);
      m.push_if(lit_.data());
      entered_.assign(m.current(), m.current() + m.words());
      emitting = Emitting::kSolar;
      if (!m.any()) pc = w[0];
      break;
    }
    case Opcode::k_endilluminate:
    case Opcode::k_endsolar:
      end_emission(*this, entered_);
      emitting = Emitting::kNothing;
      m.pop_if();
      if (!m.any()) pc = w[0];
      break;
    case Opcode::k_gather:
      m.push_loop();
      // The call before may not have been made: an observer can leave it out.
      if (gathers.open(w[1] != 0)) {
        pc = next_ray(f, m, pc, w[0]);
      } else {
        m.pop_loop();
        pc = w[0] + 1 + instruction_words(code[w[0]]);
      }
      break;
    case Opcode::k_endgather: pc = next_ray(f, m, w[0], at); break;
    case Opcode::kCount: break;
    }
    // From if to continue: what works on masks.
    if (opcode >= static_cast<uint16_t>(Opcode::k_if) && opcode <= static_cast<uint16_t>(Opcode::k_continue))
      narrow(f, m);
  }
}

// Goes to the next ray that a lane still in the loop has, at `body`; after the last one past the endgather at
// `end`, or to where that says when no lane is left.
uint32_t ShaderRun::next_ray(const Frame& f, MaskStack& m, uint32_t body, uint32_t end) {
  GatherLoop& loop = *gathers.current();
  if (loop.next(*this, m.in_loop()) && take_round(end, mask_count(m.in_loop(), f.active))) {
    m.enter_round(loop.lanes());
    return body;
  }
  gathers.close();
  m.pop_loop();
  return m.any() ? end + 1 + instruction_words(program.code[end]) : program.code[end + 2];
}

// Goes to the next light that reaches a lane still in the loop, at `body`; after the last one past the
// endilluminance at `end`, or to where that says when no lane is left.
uint32_t ShaderRun::next_light(MaskStack& m, uint32_t body, uint32_t end) {
  if (light_loop.next(*this, m.in_loop())) {
    m.enter_round(light_loop.lanes());
    return body;
  }
  light_loop.end();
  m.pop_loop();
  return m.any() ? end + 1 + instruction_words(program.code[end]) : program.code[end + 2];
}

} // namespace slvm

// Compiled shaders from anywhere: the input is what follows the header of a .slo file, the checksum is made
// to fit. What the verifier accepts is bound and, if it has no loops that might not end, run on a small grid.
#include "slvm/format/slo.h"
#include "slvm/format/decode.h"
#include "slvm/format/disasm.h"
#include "slvm/machine.h"
#include "tests/fuzz/no_scene.h"

#include <cstring>

namespace {

std::vector<std::byte> sealed(std::span<const std::byte> payload) {
  std::vector<std::byte> file(16 + payload.size());
  std::memcpy(file.data(), "ANEMSLO", 7);
  file[7] = std::byte{slvm::kSloVersion};
  uint64_t hash = slvm::hash_bytes(payload);
  std::memcpy(file.data() + 8, &hash, sizeof hash);
  if (!payload.empty()) std::memcpy(file.data() + 16, payload.data(), payload.size());
  return file;
}

bool has_loops(const slvm::Program& p) {
  for (uint32_t at = 0; at < p.code.size(); at += 1 + slvm::instruction_words(p.code[at]))
    if (slvm::instruction_opcode(p.code[at]) == static_cast<uint16_t>(slvm::Opcode::k_loop)) return true;
  return false;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const slvm::Machine machine;
  auto shader = machine.load(sealed(std::as_bytes(std::span(data, size))));
  if (!shader) return 0;
  const slvm::Program& program = (*shader)->program();
  slvm::disassemble(program);
  if (uint64_t{program.uniform_planes} + program.grid_planes + program.strip_planes > 10000)
    return 0; // slow, not wrong
  auto instance = machine.instantiate(*shader, {});
  if (!instance || has_loops((*instance)->program())) return 0;
  slvm::NoScene scene;
  slvm::ShadingContext context(machine, scene);
  slvm::Grid grid(5, 3);
  context.run(**instance, grid);
  return 0;
}

// Writes the sample modules as IR and as .slo files without header: what the fuzzers of binary formats start
// from. Made fresh, because both name built-in functions of this version. Usage: fuzz_seeds FOLDER
#include "slvm/format/slo.h"
#include "slvm/ir/serialise.h"
#include "tests/unit/ir/samples.h"

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::string folder = argv[1];
  bool ok = true;
  for (auto& [name, m] : slvm::ir::samples()) {
    std::vector<uint8_t> ir = slvm::ir::serialise(m);
    ok &= static_cast<bool>(slvm::write_file(folder + "/ir/" + name, std::as_bytes(std::span(ir))));
    std::vector<std::byte> slo = slvm::write_slo(slvm::ir::compile(std::move(m)));
    ok &= static_cast<bool>(slvm::write_file(folder + "/slo/" + name, std::span(slo).subspan(16)));
  }
  if (!ok) std::fputs("fuzz_seeds: cannot write\n", stderr);
  return ok ? 0 : 1;
}

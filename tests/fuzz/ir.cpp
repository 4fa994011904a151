// IR from anywhere: read, and whatever is accepted goes through all passes and emission.
#include "slvm/format/verify.h"
#include "slvm/ir/emit.h"
#include "slvm/ir/passes/passes.h"
#include "slvm/ir/print.h"
#include "slvm/ir/serialise.h"
#include "slvm/ir/verify_ir.h"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  auto m = slvm::ir::deserialise({data, size});
  if (!m) return 0;
  slvm::ir::serialise(*m);
  slvm::ir::optimise(*m, 2, nullptr);
  if (std::string error = slvm::ir::verify_module(*m); !error.empty()) {
    std::fprintf(stderr, "after the passes: %s\n%s\n", error.c_str(), slvm::ir::print(*m).c_str());
    std::abort();
  }
  slvm::Program program;
  slvm::ir::emit(*m, program);
  slvm::verify_program(program);
  return 0;
}

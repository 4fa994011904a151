// IR from anywhere: read, and whatever is accepted goes through all passes and emission.
#include "slvm/format/verify.h"
#include "slvm/ir/emit.h"
#include "slvm/ir/passes/passes.h"
#include "slvm/ir/print.h"
#include "slvm/ir/serialise.h"
#include "slvm/ir/verify_ir.h"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

void demand(const std::string& error, const char* when, const slvm::ir::Module& m) {
  if (error.empty()) return;
  std::fprintf(stderr, "%s: %s\n%s\n", when, error.c_str(), slvm::ir::print(m).c_str());
  std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  auto m = slvm::ir::deserialise({data, size});
  if (!m) return 0;
  slvm::ir::serialise(*m);
  slvm::ir::optimise(*m, 2, nullptr);
  demand(slvm::ir::verify_module(*m), "after the passes", *m);
  slvm::Program program;
  program.kind = m->kind;
  slvm::ir::emit(*m, program);
  // What a module asks for may be too much for a program, but never wrong.
  std::string error = slvm::verify_program(program);
  if (error.find("than allowed") == error.npos) demand(error, "after emission", *m);
  return 0;
}

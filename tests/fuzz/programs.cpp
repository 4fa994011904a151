// Bytes are decisions about a program: it must compile, and compute the same however it is run.
#include "tests/fuzz/programs/differential.h"

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  slvm::test::Choices choices({data, data + size});
  const slvm::test::RandomProgram program = slvm::test::random_program(choices);
  const std::string wrong = slvm::test::disagreement(program);
  if (wrong.empty()) return 0;
  std::fprintf(stderr, "%s\n%s\n", program.source.c_str(), wrong.c_str());
  std::abort();
}

// random_programs FIRST COUNT: random programs number FIRST to FIRST + COUNT - 1, run in all ways. Of one
// that fails it prints a small version. --show N prints program N; --check FILE runs a program that was
// printed.
#include "tests/fuzz/programs/differential.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>

namespace {

using namespace slvm::test;

std::vector<uint8_t> bytes_of(unsigned number) {
  std::mt19937 random(number);
  std::vector<uint8_t> bytes(200 + random() % 1500);
  for (uint8_t& b : bytes)
    b = static_cast<uint8_t>(random());
  return bytes;
}

RandomProgram program_of(const std::vector<uint8_t>& bytes) {
  Choices choices(bytes);
  return random_program(choices);
}

int check(unsigned number) {
  const std::vector<uint8_t> bytes = bytes_of(number);
  const std::string wrong = disagreement(program_of(bytes));
  if (wrong.empty()) return 0;
  std::printf("program %u: %s\n", number, wrong.c_str());
  const RandomProgram small = program_of(shrink(bytes));
  std::printf("%s%s%s\n", small.source.c_str(), small.light.c_str(), disagreement(small).c_str());
  return 1;
}

} // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0); // what was found stays, however the run ends
  if (argc != 3) {
    std::fputs("usage: random_programs FIRST COUNT | --show NUMBER | --check FILE\n", stderr);
    return 2;
  }
  if (!std::strcmp(argv[1], "--check")) {
    std::ifstream file(argv[2]);
    RandomProgram program;
    program.source = {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const std::string wrong = disagreement(program);
    std::printf("%s\n", wrong.empty() ? "fine" : wrong.c_str());
    return wrong.empty() ? 0 : 1;
  }
  const auto last = static_cast<unsigned>(std::atoi(argv[2]));
  if (!std::strcmp(argv[1], "--show")) {
    const RandomProgram program = program_of(bytes_of(last));
    std::printf("%s%s", program.source.c_str(), program.light.c_str());
    return 0;
  }
  const auto first = static_cast<unsigned>(std::atoi(argv[1]));
  int wrong = 0;
  for (unsigned number = first; number < first + last; ++number)
    wrong += check(number);
  std::printf("%u programs, %d wrong\n", last, wrong);
  return wrong ? 1 : 0;
}

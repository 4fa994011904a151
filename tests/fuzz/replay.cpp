// Runs a fuzz target without libFuzzer: on all files of the given folders, and on damaged copies of each, the
// same ones every time. Usage: replay_NAME DAMAGED FOLDER...
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

using Bytes = std::vector<uint8_t>;

/// Flips bits, repeats, removes and overwrites stretches: what libFuzzer does, without feedback.
class Damage {
public:
  Bytes apply(Bytes bytes) {
    for (uint32_t k = 1 + below(4); k > 0 && !bytes.empty(); --k) {
      size_t at = below(static_cast<uint32_t>(bytes.size()));
      size_t end = std::min(bytes.size(), at + 1 + below(8));
      auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at),
           stop = bytes.begin() + static_cast<std::ptrdiff_t>(end);
      switch (below(4)) {
      case 0: *begin ^= static_cast<uint8_t>(1u << below(8)); break;
      case 1: *begin = static_cast<uint8_t>(below(256)); break;
      case 2: bytes.erase(begin, stop); break;
      case 3: {
        Bytes copy(begin, stop);
        bytes.insert(bytes.begin() + below(static_cast<uint32_t>(bytes.size())), copy.begin(), copy.end());
        break;
      }
      }
    }
    return bytes;
  }

private:
  uint32_t below(uint32_t n) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<uint32_t>(state_ >> 33) % n;
  }
  uint64_t state_ = 1;
};

std::vector<std::filesystem::path> inputs(const char* folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: replay_NAME DAMAGED FOLDER...\n", stderr);
    return 2;
  }
  int damaged = std::atoi(argv[1]), runs = 0;
  Damage damage;
  for (int i = 2; i < argc; ++i)
    for (const auto& path : inputs(argv[i])) {
      std::ifstream in(path, std::ios::binary);
      Bytes bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
      for (int k = 0; k <= damaged; ++k, ++runs) {
        Bytes input = k == 0 ? bytes : damage.apply(bytes);
        LLVMFuzzerTestOneInput(input.data(), input.size());
      }
    }
  std::printf("%d inputs\n", runs);
  return runs > 0 ? 0 : 1;
}

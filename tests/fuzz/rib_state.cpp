// Whole RIB scenes from anywhere, up to what would be rendered: conditions, archives, procedurals, blocks and
// geometry. Programs are not run.
#include "render/state/interpreter.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  render::Interpreter interpreter(sources, diagnostics, {});
  interpreter.most_replayed = 10000;
  interpreter.read_text("fuzz.rib", std::string(reinterpret_cast<const char*>(data), size));
  interpreter.finish();
  slvm::format_diagnostics(diagnostics, sources);
  return 0;
}

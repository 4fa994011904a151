// RSL source from anywhere, through preprocessor, parser, analysis and code generation. No files are read.
#include "slc/compiler.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size > 20'000) return 0;
  static const slc::Compiler compiler;
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  slc::CompileOptions options;
  options.preprocess.read = [](const std::string&) { return std::nullopt; };
  std::string text(reinterpret_cast<const char*>(data), size);
  compiler.compile(sources.add("fuzz.sl", std::move(text)), options, sources, diagnostics);
  slvm::format_diagnostics(diagnostics, sources);
  return 0;
}

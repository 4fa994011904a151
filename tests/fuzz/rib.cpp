// RIB from anywhere, through lexer and parser; the requests go nowhere.
#include "render/rib/parser.h"

namespace {

class Nobody : public render::RiTarget {
public:
  void request(const render::RequestCall&) override {}
  void unknown_request(std::string_view, std::string_view, slvm::SourceRange) override {}
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Nobody nobody;
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics;
  slvm::FileId file = sources.add("fuzz.rib", std::string(reinterpret_cast<const char*>(data), size));
  render::parse_rib(sources.text(file), file, nobody, diagnostics);
  slvm::format_diagnostics(diagnostics, sources);
  return 0;
}

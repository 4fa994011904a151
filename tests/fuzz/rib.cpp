// RIB from anywhere (ASCII, encoded, compressed), through lexer and parser; the requests go nowhere.
#include "render/rib/gzip.h"
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
  std::string text(reinterpret_cast<const char*>(data), size);
  constexpr size_t kLimit = 1 << 20;
  if (render::is_gzip(text)) text = render::unpack_gzip(text, kLimit).text;
  slvm::FileId file = sources.add("fuzz.rib", std::move(text));
  render::parse_rib(sources.text(file), file, nobody, diagnostics);
  slvm::format_diagnostics(diagnostics, sources);
  return 0;
}

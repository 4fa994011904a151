// RIB from anywhere (ASCII, encoded, compressed), through lexer and parser. What the requests are written as
// must be read without an error, and as many.
#include "render/rib/gzip.h"
#include "render/rib/parser.h"
#include "render/rib/writer.h"

#include <cstdlib>

namespace {

/// Counts requests, and hands them on.
class Counter : public render::RiTarget {
public:
  explicit Counter(render::RiTarget* next) : next_(next) {}
  void request(const render::RequestCall& call) override {
    ++requests;
    // The end of content that is no RIB is found by its name as it stands in the file: some have no way to be
    // written.
    plain = plain && call.data.empty();
    if (next_) next_->request(call);
  }
  void unknown_request(std::string_view, std::string_view, slvm::SourceRange) override {}
  bool wants_comments() const override { return next_ != nullptr; }
  void comment(std::string_view text, slvm::SourceRange where) override {
    if (next_) next_->comment(text, where);
  }

  size_t requests = 0;
  bool plain = true;

private:
  render::RiTarget* next_;
};

void check(const std::string& text, bool binary) {
  slvm::SourceManager sources;
  slvm::Diagnostics diagnostics, none;
  std::string written;
  render::RibWriter writer([&](std::string_view piece) { written += piece; }, {binary, 0});
  Counter first(&writer), second(nullptr);
  slvm::FileId file = sources.add("fuzz.rib", text);
  render::parse_rib(sources.text(file), file, first, diagnostics);
  slvm::format_diagnostics(diagnostics, sources);
  if (!first.plain) return;
  file = sources.add("written.rib", written);
  render::parse_rib(sources.text(file), file, second, none);
  // The version may be the writer's own.
  bool same = second.requests == first.requests || second.requests == first.requests + 1;
  if (none.has_errors() || !same) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  constexpr size_t kLimit = 1 << 20;
  if (render::is_gzip(text)) text = render::unpack_gzip(text, kLimit).text;
  check(text, false);
  check(text, true);
  return 0;
}

// The pages of a coverage report: plain HTML, each complete in itself.
#include "slvm/format/slo.h"
#include "slvm/tools/sltest/coverage.h"

#include <fmt/format.h>

#include <filesystem>

namespace slvm::sltest {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{}</title>
<style>
body {{ font-family: sans-serif; margin: 2em; color: #222; background: #fff }}
table {{ border-collapse: collapse }}
td, th {{ padding: 0 0.8em; text-align: left; vertical-align: top }}
td.n {{ text-align: right; color: #666 }}
td.c {{ font-family: monospace; white-space: pre }}
tr.run td.c {{ background: #e4f4e4 }}
tr.missed td.c {{ background: #fbdcdc }}
tr.partly td.c {{ background: #fdf3d0 }}
</style></head><body>
<h1>{}</h1>
)";

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text)
    out += c == '&'   ? "&amp;"
           : c == '<' ? "&lt;"
           : c == '>' ? "&gt;"
           : c == '"' ? "&quot;"
                      : std::string(1, c);
  return out;
}

std::string page_name(const std::string& file) {
  std::string name;
  for (char c : file)
    name += c == '/' || c == '\\' || c == ':' ? '_' : c;
  return name + ".html";
}

std::string summary(const FileCoverage& f) {
  return fmt::format("lines {} of {}, branches {} of {}", f.lines_run(), f.lines.size(), f.ways_taken(),
                     2 * f.branches.size());
}

std::string branch_text(const BranchCoverage& b) {
  if (!b.yes && !b.no) return fmt::format("{} not run", b.what);
  return fmt::format("{} true {} false {}", b.what, b.yes, b.no);
}

std::string page(const FileCoverage& f) {
  std::string text = fmt::format(fmt::runtime(kHead), escaped(f.file), escaped(f.file));
  text += fmt::format(
      "<p>{}</p>\n<table>\n<tr><th>line</th><th>points</th><th>source</th><th>branches</th></tr>\n",
      summary(f));
  uint32_t line = 1;
  for (size_t at = 0; at < f.text.size(); ++line) {
    const size_t end = std::min(f.text.find('\n', at), f.text.size());
    std::string branches;
    bool partly = false;
    for (const BranchCoverage& b : f.branches) {
      if (b.line != line) continue;
      branches += (branches.empty() ? "" : "; ") + branch_text(b);
      partly = partly || !b.yes || !b.no;
    }
    auto count = f.lines.find(line);
    const bool counted = count != f.lines.end();
    const char* colour = !counted         ? (branches.empty() ? ""
                                             : partly         ? "partly"
                                                              : "run")
                         : !count->second ? "missed"
                         : partly         ? "partly"
                                          : "run";
    text +=
        fmt::format("<tr class=\"{}\"><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"c\">{}</td>"
                    "<td>{}</td></tr>\n",
                    colour, line, counted ? fmt::format("{}", count->second) : "",
                    escaped(f.text.substr(at, end - at)), branches);
    at = end + 1;
  }
  return text + "</table>\n</body></html>\n";
}

} // namespace

Result<bool> write_coverage_pages(const std::string& folder, const std::vector<FileCoverage>& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Error{fmt::format("{}: {}", folder, error.message())};
  std::string index = fmt::format(fmt::runtime(kHead), "Coverage", "Coverage");
  index += "<table>\n";
  auto write = [&](const std::string& name, const std::string& text) {
    return write_file((std::filesystem::path(folder) / name).string(),
                      std::as_bytes(std::span(text.data(), text.size())));
  };
  for (const FileCoverage& f : files) {
    auto written = write(page_name(f.file), page(f));
    if (!written) return written;
    index += fmt::format("<tr><td><a href=\"{0}\">{1}</a></td><td>{2}</td></tr>\n",
                         escaped(page_name(f.file)), escaped(f.file), summary(f));
  }
  return write("index.html", index + "</table>\n</body></html>\n");
}

} // namespace slvm::sltest

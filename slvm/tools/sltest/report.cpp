#include "slvm/tools/sltest/report.h"

#include <fmt/format.h>

namespace slvm::sltest {
namespace {

/// A table has many variants; this many failures of one case tell enough.
constexpr size_t kShownFailures = 5;

std::string escaped(std::string_view text) {
  std::string result;
  for (char c : text) {
    switch (c) {
    case '&': result += "&amp;"; break;
    case '<': result += "&lt;"; break;
    case '>': result += "&gt;"; break;
    case '"': result += "&quot;"; break;
    default: result += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? '?' : c;
    }
  }
  return result;
}

std::string failures_text(const CaseReport& r) {
  std::string text;
  for (size_t i = 0; i < r.failures.size() && i < kShownFailures; ++i) {
    const CheckFailure& f = r.failures[i];
    text += f.where.file.empty() ? f.text + '\n' : fmt::format("{}: {}\n", to_string(f.where), f.text);
  }
  if (r.failures.size() > kShownFailures)
    text += fmt::format("and {} more\n", r.failures.size() - kShownFailures);
  return text;
}

size_t failed_count(const FileReport& report) {
  size_t count = 0;
  for (const CaseReport& r : report.cases)
    count += !r.passed();
  return count;
}

} // namespace

std::string report_text(const FileReport& report, bool verbose) {
  std::string text;
  for (const CaseReport& r : report.cases) {
    for (const std::string& file : r.updated)
      text += fmt::format("updated {}\n", file);
    if (r.passed() && !verbose) continue;
    text += fmt::format("{} {}: {}", r.passed() ? "pass" : "FAIL", to_string(r.test->where), r.test->name);
    if (verbose) text += fmt::format(" ({} runs, {:.1f} ms)", r.runs, 1000 * r.seconds);
    text += '\n';
    std::string failures = failures_text(r);
    for (size_t at = 0; at < failures.size();) {
      const size_t end = failures.find('\n', at);
      text += "  " + failures.substr(at, end - at + 1);
      at = end + 1;
    }
  }
  return text;
}

std::string summary_text(const std::deque<FileReport>& reports) {
  size_t cases = 0, failed = 0, files = 0;
  for (const FileReport& r : reports) {
    files += !r.unreadable;
    cases += r.cases.size();
    failed += failed_count(r);
  }
  if (failed) return fmt::format("{} of {} cases failed\n", failed, cases);
  return fmt::format("{} case{} in {} file{} passed\n", cases, cases == 1 ? "" : "s", files,
                     files == 1 ? "" : "s");
}

bool all_passed(const std::deque<FileReport>& reports) {
  for (const FileReport& r : reports)
    if (failed_count(r) || r.unreadable) return false;
  return true;
}

std::string junit_text(const std::deque<FileReport>& reports) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const FileReport& report : reports) {
    double seconds = 0;
    for (const CaseReport& r : report.cases)
      seconds += r.seconds;
    text +=
        fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.4f}\">\n",
                    escaped(report.file.name), report.cases.size() + report.unreadable, failed_count(report),
                    report.unreadable ? 1 : 0, seconds);
    if (report.unreadable)
      text += fmt::format(
          "    <testcase name=\"file\" classname=\"{}\"><error message=\"missing or wrong\"/></testcase>\n",
          escaped(report.file.name));
    for (const CaseReport& r : report.cases) {
      text +=
          fmt::format("    <testcase name=\"{}\" classname=\"{}\" file=\"{}\" line=\"{}\" time=\"{:.4f}\"",
                      escaped(r.test->name), escaped(report.file.name), escaped(r.test->where.file),
                      r.test->where.line, r.seconds);
      if (r.passed())
        text += "/>\n";
      else
        text += fmt::format(">\n      <failure message=\"{}\">{}</failure>\n    </testcase>\n",
                            escaped(r.failures[0].text.substr(0, r.failures[0].text.find('\n'))),
                            escaped(failures_text(r)));
    }
    text += "  </testsuite>\n";
  }
  return text + "</testsuites>\n";
}

} // namespace slvm::sltest

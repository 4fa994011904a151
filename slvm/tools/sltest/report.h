// What test runs say: text for people, JUnit XML for build servers.
#pragma once

#include "slvm/tools/sltest/case_runner.h"

#include <deque>
#include <string>

namespace slvm::sltest {

struct FileReport {
  TestFile file;
  bool unreadable = false; ///< it is missing or wrong: no case ran
  std::deque<CaseReport> cases;
};

/// The failures of a file, and with `verbose` a line for each case.
std::string report_text(const FileReport& report, bool verbose);
/// "15 cases in 2 files passed" or "3 of 15 cases failed".
std::string summary_text(const std::deque<FileReport>& reports);
/// No case failed, and every file could be read.
bool all_passed(const std::deque<FileReport>& reports);
/// JUnit: a testsuite for each file, a testcase for each case.
std::string junit_text(const std::deque<FileReport>& reports);

} // namespace slvm::sltest

// What tests of the programs slc and sloinfo share: running them in a folder of their own.
#pragma once

#include "tests/temp_folder.h"

#include <array>
#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>

namespace slc_test {

/// A folder of its own for each test, where slc and sloinfo run.
class Tool : public testing::Test {
protected:
  void write(const std::string& name, const std::string& text) { folder_.write(name, text); }
  /// Runs slc; the exit code. Both output streams go to output_. `environment`: assignments before the
  /// command.
  int run(const std::string& arguments, const std::string& environment = "") {
    return run_program(environment + " " + SLC_PROGRAM + " " + arguments);
  }
  int sloinfo(const std::string& arguments) {
    return run_program(std::string(SLOINFO_PROGRAM) + " " + arguments);
  }
  int run_program(const std::string& words) {
    std::string command = "cd '" + folder_.string() + "' && " + words + " 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    output_.clear();
    std::array<char, 4096> buffer;
    for (size_t n; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      output_.append(buffer.data(), n);
    return WEXITSTATUS(pclose(pipe));
  }
  bool exists(const std::string& name) { return folder_.has(name); }
  std::string read(const std::string& name) { return exists(name) ? folder_.read(name) : "none"; }

  anemone::test::TempFolder folder_;
  std::string output_;
};

} // namespace slc_test

// What tests of the programs slc and sloinfo share: running them in a folder of their own.
#pragma once

#include "slc/preprocess/preprocess.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace slc_test {

/// A folder of its own for each test, where slc and sloinfo run.
class Tool : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("slc_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
               std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
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
  bool exists(const std::string& name) { return std::filesystem::exists(folder_ / name); }
  std::string read(const std::string& name) {
    return slc::read_file((folder_ / name).string()).value_or("none");
  }

  std::filesystem::path folder_;
  std::string output_;
};

} // namespace slc_test

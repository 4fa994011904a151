// slrender as users run it, in a folder of the test's own.
#pragma once

#include "tests/temp_folder.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/wait.h>
#include <vector>

#ifndef SLRENDER_PROGRAM // the build says where it is
#define SLRENDER_PROGRAM "slrender"
#endif

namespace anemone::test {

class SlrenderTest : public ::testing::Test {
protected:
  void file(const std::string& name, const std::string& text) { directory_.write(name, text); }
  bool exists(const std::string& name) const { return directory_.has(name); }

  struct Outcome {
    int status;
    std::string text; ///< standard output and errors together
  };
  /// Runs slrender in the test's directory.
  Outcome run(const std::string& arguments) {
    return run_command(fmt::format("'{}' {}", SLRENDER_PROGRAM, arguments));
  }
  Outcome run_command(const std::string& words) {
    std::string command = fmt::format("cd '{}' && {} 2>&1", directory_.string(), words);
    std::FILE* pipe = ::popen(command.c_str(), "r");
    Outcome out{-1, {}};
    char buffer[4096];
    for (size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
      out.text.append(buffer, n);
    int status = ::pclose(pipe);
    out.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return out;
  }
  /// All channels of an image, or nothing when it cannot be read.
  std::vector<float> pixels(const std::string& name) const {
    auto in = OIIO::ImageInput::open((directory_ / name).string());
    if (!in) return {};
    const OIIO::ImageSpec& spec = in->spec();
    std::vector<float> out(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                           static_cast<size_t>(spec.nchannels));
    if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, out.data())) out.clear();
    return out;
  }

  TempFolder directory_;
};

} // namespace anemone::test

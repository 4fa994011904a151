// For tests of the C interface: errors as data, RIB files as text.
#pragma once

#include "render/ri/ri.h"
#include "tests/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace render::testing {

/// What the handler of a test was told, as "CODE severity: text".
inline std::vector<std::string>& told() {
  static std::vector<std::string> list;
  return list;
}

inline void remember(RtInt code, RtInt severity, char* message) {
  told().push_back(fmt::format("{} {}: {}", code, severity, message));
}

class RiTest : public ::testing::Test {
protected:
  void SetUp() override {
    RiContext(nullptr);
    RiErrorHandler(remember);
    told().clear();
  }
  void TearDown() override {
    while (RiGetContext())
      RiEnd();
  }
  /// Begins a RIB file.
  void begin_file() { RiBegin((folder_ / "t.rib").c_str()); }
  /// Ends it; its text without the header.
  std::string end_file() {
    RiEnd();
    std::string text = folder_.read("t.rib"), header = "##RenderMan RIB\nversion 3.04\n";
    return text.starts_with(header) ? text.substr(header.size()) : text;
  }

  anemone::test::TempFolder folder_;
};

} // namespace render::testing

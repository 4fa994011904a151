// Calls with random arguments for every request, and what a parser makes of RIB text: for tests of writer and
// parser together.
#pragma once

#include "render/rib/parser.h"

#include <random>
#include <string>
#include <utility>
#include <vector>

namespace render::testing {

/// Keeps what it receives.
class CallList : public RiTarget {
public:
  void request(const RequestCall& call) override { calls.push_back(call); }
  void unknown_request(std::string_view name, std::string_view, slvm::SourceRange) override {
    unknown.emplace_back(name);
  }
  bool wants_comments() const override { return true; }
  void comment(std::string_view text, slvm::SourceRange) override {
    comments.emplace_back(calls.size(), text);
  }

  std::vector<RequestCall> calls;
  std::vector<std::string> unknown;
  std::vector<std::pair<size_t, std::string>> comments; ///< with the number of calls before each
};

class RandomCalls {
public:
  explicit RandomCalls(unsigned seed) : random_(seed) {}
  RequestCall make(RequestId id);

private:
  bool flip() { return random_() % 2 == 0; }
  float number();
  std::string text();
  void argument(const ArgumentInfo& info, Argument& a);
  void param(RequestCall& call);

  std::mt19937 random_;
};

/// Requests of the text. `messages` receives errors.
CallList parse_calls(const std::string& text, std::string* messages = nullptr);

/// "", or the first difference in anything but positions.
std::string difference(const RequestCall& a, const RequestCall& b);

} // namespace render::testing

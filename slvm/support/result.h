// Result<T>: a value, or the text of why there is none. PUBLIC. For loaders and other calls with one possible
// error; anything with positions or several messages takes a Diagnostics& instead.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace slvm {

struct Error {
  std::string text;
};

template <class T> class [[nodiscard]] Result {
public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() {
    assert(state_.index() == 0);
    return std::get<0>(state_);
  }
  const T& operator*() const {
    assert(state_.index() == 0);
    return std::get<0>(state_);
  }
  T* operator->() { return &**this; }
  const T* operator->() const { return &**this; }
  const std::string& error() const {
    assert(state_.index() == 1);
    return std::get<1>(state_).text;
  }

private:
  std::variant<T, Error> state_;
};

} // namespace slvm

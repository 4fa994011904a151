// Functions that are called for each point: argv[0] is the result, argv[i] the address of argument i.
#include "slvm/exec/plugin_call.h"
#include "slvm/exec/run.h"
#include "slvm/plugin/sdk/shadeop.h"
#include "slvm/support/crash_guard.h"

#include <bit>
#include <cstring>

namespace slvm {
namespace {

using PointFunction = int (*)(void*, int, void**);

constexpr size_t kStringRoom = 1024;       // that functions may write to
constexpr size_t kLongestString = 1 << 20; // that is taken over from them

// An argument of one point after the other.
class Argument {
public:
  Argument(const PluginOperand& operand, StringPool& strings)
      : o_(operand), strings_(strings), count_(operand.elements()),
        planes_(static_cast<size_t>(components(operand.what.type))) {
    if (o_.what.type == Type::kString) {
      texts_.resize(count_);
      pointers_.resize(std::max<size_t>(count_, 1));
    } else {
      numbers_.resize(std::max<size_t>(planes_ * count_, 1));
    }
  }

  void* address() {
    if (o_.what.type != Type::kString) return numbers_.data();
    return o_.what.array ? static_cast<void*>(pointers_.data()) : &description_;
  }

  /// What the operands hold at this point.
  void load(size_t point) {
    if (o_.what.type == Type::kString) return load_strings(point);
    if (!o_.from) {
      std::fill(numbers_.begin(), numbers_.end(), 0.0f);
      return;
    }
    const Operand& p = o_.from->planes;
    for (size_t i = 0; i < planes_ * count_; ++i)
      numbers_[i] = p.plane(i)[p.step * point];
  }

  void store(size_t point) {
    if (!o_.to) return;
    const Operand& p = o_.to->planes;
    for (size_t i = 0; i < planes_ * count_; ++i) {
      const float value = o_.what.type == Type::kString ? stored_text(i) : numbers_[i];
      if (p.step)
        p.plane(i)[point] = value;
      else
        std::fill_n(p.plane(i), kMaxLanes, value);
    }
  }

private:
  void load_strings(size_t point) {
    for (size_t i = 0; i < count_; ++i) {
      uint32_t id = 0;
      if (o_.from) id = std::bit_cast<uint32_t>(o_.from->planes.plane(i)[o_.from->planes.step * point]);
      const std::string_view text = strings_.text(id);
      std::vector<char>& room = texts_[i];
      room.resize(std::max(kStringRoom, text.size() + 1));
      std::memcpy(room.data(), text.data(), text.size());
      room[text.size()] = '\0';
      pointers_[i] = room.data();
    }
    description_.s = pointers_[0];
    description_.bufflen = count_ ? static_cast<int>(texts_[0].size()) : 0;
  }

  float stored_text(size_t i) {
    const char* s = o_.what.array ? pointers_[i] : description_.s;
    const std::string_view text = s ? std::string_view(s, ::strnlen(s, kLongestString)) : std::string_view();
    return std::bit_cast<float>(strings_.intern(text));
  }

  const PluginOperand& o_;
  StringPool& strings_;
  size_t count_, planes_;
  std::vector<float> numbers_;
  std::vector<std::vector<char>> texts_;
  std::vector<char*> pointers_; // of an array
  STRING_DESC description_{};   // of one string
};

} // namespace

std::string call_by_point(const GridCall& call, HostedFunction& function,
                          std::span<const PluginOperand> operands, std::span<const uint32_t> points) {
  std::string error;
  void* data = nullptr;
  if (!call.run.state.plugins->init_data(function, data, error)) return error;
  std::vector<Argument> arguments;
  std::vector<void*> addresses;
  arguments.reserve(operands.size());
  for (const PluginOperand& o : operands)
    addresses.push_back(arguments.emplace_back(o, call.run.state.machine.strings()).address());
  const auto entry = reinterpret_cast<PointFunction>(function.entry.entry);
  // A uniform argument is the function's own: it goes on from point to point with what it stored there.
  auto moves = [&](size_t i) {
    return i == 0 || !operands[i].to || operands[i].to->planes.step || operands[i].to->array;
  };
  bool first = true;
  return call_catching([&] {
    for (uint32_t point : points) {
      for (size_t i = 0; i < arguments.size(); ++i)
        if (first || moves(i)) arguments[i].load(point);
      first = false;
      std::vector<void*>& argv = addresses;
      entry(data, static_cast<int>(argv.size()), argv.data());
      for (Argument& a : arguments)
        a.store(point);
    }
  });
}

} // namespace slvm

// Functions that are called once for a grid: arguments as arrays of values, point after point.
#include "slvm/exec/plugin_call.h"
#include "slvm/exec/run.h"
#include "slvm/support/crash_guard.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>

namespace slvm {

constexpr size_t kLongestText = 1 << 20; // of a string that is taken over from a function
constexpr size_t kRoomOfNothing = 16;

class PluginArgument final : public RslArg, private RslResizer {
public:
  /// Takes the values of all points of the grid (strings: of the active ones).
  void load(const GridCall& call, const PluginOperand& o, std::span<const uint32_t> points,
            const PluginContext& context) {
    call_ = &call;
    context_ = &context;
    what_ = o.what;
    name_ = std::string(o.what.name);
    length_ = o.what.array ? o.elements() : 0;
    capacity_ = o.elements();
    varying_ = o.varying();
    writeable_ = o.to != nullptr;
    values_ = varying_ ? static_cast<unsigned int>(points.size()) : 1;
    too_long_ = 0;
    const size_t all = varying_ ? call.run.points : 1;
    per_point_ = capacity_ * static_cast<size_t>(std::max(components(o.what.type), 1));
    if (is_string()) {
      load_strings(call, o, points, all);
      return;
    }
    // Of nothing there is room for anything: functions without a result have been seen to set it.
    numbers_.assign(o.what.type == Type::kVoid ? kRoomOfNothing : all * per_point_, 0.0f);
    if (!o.from) return;
    const Operand& p = o.from->planes;
    const size_t first = points.front(); // of a varying array that is passed as uniform
    for (size_t c = 0; c < per_point_; ++c)
      for (size_t i = 0; i < all; ++i)
        numbers_[i * per_point_ + c] = p.plane(c)[p.step * (varying_ ? i : first)];
  }

  void store(const PluginOperand& o, std::span<const uint32_t> points) {
    if (!o.to) return;
    const Operand& p = o.to->planes;
    StringPool& strings = call_->run.state.machine.strings();
    auto value = [&](size_t point, size_t c) {
      if (!is_string()) return numbers_[point * per_point_ + c];
      const char* s = texts_[point * per_point_ + c];
      return std::bit_cast<float>(strings.intern(s ? std::string_view(s, ::strnlen(s, kLongestText)) : ""));
    };
    for (size_t c = 0; c < per_point_; ++c)
      if (p.step)
        for (uint32_t point : points)
          p.plane(c)[point] = value(varying_ ? point : 0, c);
      else
        std::fill_n(p.plane(c), kMaxLanes, value(0, c));
  }

  /// "" or what the function asked of the array that it cannot have.
  std::string complaint() const {
    return too_long_ ? fmt::format("it wants {} elements in '{}', which holds {}: declare a longer array",
                                   too_long_, name_, capacity_)
                     : std::string();
  }

  bool IsFloat() const override { return what_.type == Type::kFloat; }
  bool IsPoint() const override { return what_.type == Type::kPoint; }
  bool IsVector() const override { return what_.type == Type::kVector; }
  bool IsNormal() const override { return what_.type == Type::kNormal; }
  bool IsColor() const override { return what_.type == Type::kColor; }
  bool IsMatrix() const override { return what_.type == Type::kMatrix; }
  bool IsString() const override { return is_string(); }
  bool IsArray() const override { return what_.array; }
  bool IsVarying() const override { return varying_; }
  bool IsWriteable() const override { return writeable_; }
  bool IsResizable() const override { return writeable_ && what_.array && what_.elements == 0; }
  RslResizer* GetResizer() const override {
    return IsResizable() ? const_cast<PluginArgument*>(this) : nullptr;
  }
  int GetArrayLength() const override { return static_cast<int>(length_); }
  unsigned int NumValues() const override { return values_; }
  void GetData(float** data, int* stride) const override {
    *data = begin();
    *stride = varying_ ? float_stride() : 0;
  }
  const char* GetName() const override { return name_.c_str(); }

private:
  void iterate(float** data, int* stride, const RslIncrType** steps) const override {
    *stride = varying_ ? float_stride() : 0;
    *data = begin() + static_cast<size_t>(*stride) * context_->first_active;
    *steps = context_->increments.data();
  }
  void Resize(int length) override {
    if (length < 0 || static_cast<size_t>(length) > capacity_)
      too_long_ = length;
    else
      length_ = static_cast<uint32_t>(length);
  }

  bool is_string() const { return what_.type == Type::kString; }
  float* begin() const {
    return is_string() ? reinterpret_cast<float*>(const_cast<char**>(texts_.data()))
                       : const_cast<float*>(numbers_.data());
  }
  int float_stride() const {
    return static_cast<int>(per_point_ * (is_string() ? sizeof(char*) / sizeof(float) : 1));
  }

  void load_strings(const GridCall& call, const PluginOperand& o, std::span<const uint32_t> points,
                    size_t all) {
    nothing_ = '\0';
    texts_.assign(all * per_point_, &nothing_);
    if (!o.from) return;
    const Operand& p = o.from->planes;
    const StringPool& strings = call.run.state.machine.strings();
    auto text = [&](size_t point, size_t c) {
      return const_cast<char*>(strings.text(std::bit_cast<uint32_t>(p.plane(c)[p.step * point])).data());
    };
    for (size_t c = 0; c < per_point_; ++c) {
      if (!varying_) texts_[c] = text(points.front(), c);
      for (size_t i = 0; varying_ && i < points.size(); ++i)
        texts_[points[i] * per_point_ + c] = text(points[i], c);
    }
  }

  const GridCall* call_ = nullptr;
  const PluginContext* context_ = nullptr;
  SignatureParam what_;
  std::string name_;
  uint32_t length_ = 0, capacity_ = 1;
  size_t per_point_ = 1;
  bool varying_ = false, writeable_ = false;
  unsigned int values_ = 1;
  int too_long_ = 0;
  std::vector<float> numbers_;
  std::vector<char*> texts_;
  char nothing_ = '\0'; ///< the text of points that are not active
};

PluginThread::Memory::Memory() = default;
PluginThread::Memory::~Memory() = default;

namespace {

void prepare_context(PluginContext& context, const GridCall& call, std::span<const uint32_t> points) {
  context.flags.assign(call.run.points, 0);
  for (uint32_t point : points)
    context.flags[point] = 1;
  context.first_active = points.front();
  context.increments.assign(points.size() + 16, 0); // one step too many stays where it is
  for (size_t i = 0; i + 1 < points.size(); ++i)
    context.increments[i] = points[i + 1] - points[i];
}

} // namespace

std::string call_by_grid(const GridCall& call, HostedFunction& function,
                         std::span<const PluginOperand> operands, std::span<const uint32_t> points) {
  PluginThread& thread = *call.run.state.plugins;
  prepare_context(thread.context(), call, points);
  std::vector<std::unique_ptr<PluginArgument>>& arguments = thread.memory.arguments;
  std::vector<const RslArg*> argv;
  for (size_t i = 0; i < operands.size(); ++i) {
    if (i == arguments.size()) arguments.push_back(std::make_unique<PluginArgument>());
    arguments[i]->load(call, operands[i], points, thread.context());
    argv.push_back(arguments[i].get());
  }
  const auto entry = reinterpret_cast<RslEntryFunc>(function.entry.entry);
  int status = 0;
  std::string error =
      call_catching([&] { status = entry(&thread.context(), static_cast<int>(argv.size()), argv.data()); });
  if (!error.empty()) return error;
  if (status != 0) return fmt::format("it returned {}, which says that it failed", status);
  for (size_t i = 0; i < operands.size(); ++i) {
    arguments[i]->store(operands[i], points);
    if (error.empty()) error = arguments[i]->complaint();
  }
  return error;
}

} // namespace slvm

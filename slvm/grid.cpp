// Storage of a grid's variables: planes handed out from a few large blocks that live as long as the grid.
#include "slvm/grid.h"

#include "slvm/support/string_pool.h"
#include "slvm/wide/operand.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace slvm {

namespace {
constexpr size_t kFloatsPerLine = kPlaneAlign / sizeof(float);
constexpr size_t kBlockFloats = size_t{1} << 14;

size_t padded(size_t points) {
  return (points + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
}

void fill_uniform(float* planes, std::span<const float> value) {
  for (size_t i = 0; i < value.size(); ++i)
    std::fill_n(planes + i * kMaxLanes, kMaxLanes, value[i]);
}
} // namespace

Grid::Grid(int nu, int nv) : nu_(nu), nv_(nv), pitch_(padded(points())) {
  assert(nu > 0 && nv > 0);
}

float* Grid::allocate(size_t planes, size_t pitch) {
  size_t need = planes * pitch;
  for (Block& b : blocks_)
    if (b.size - b.used >= need) {
      float* out = b.memory.get() + b.used;
      b.used += need;
      auto misaligned = reinterpret_cast<uintptr_t>(b.memory.get()) / sizeof(float) % kFloatsPerLine;
      return out + (misaligned ? kFloatsPerLine - misaligned : 0);
    }
  Block& b = blocks_.emplace_back();
  b.size = std::max(need, kBlockFloats);
  b.memory = std::make_unique<float[]>(b.size + kFloatsPerLine); // room to align the start
  return allocate(planes, pitch);
}

float* Grid::varying(Global g) {
  const Planes before = variable(g);
  if (before.data && before.step) return before.data;
  float* data = to_fill(g);
  for (size_t i = 0; i < static_cast<size_t>(components(variable(g).type)); ++i)
    std::fill_n(data + i * pitch_, pitch_, before.data ? before.data[i * before.pitch] : 0.0f);
  return data;
}

float* Grid::to_fill(Global g) {
  Planes& p = globals_[static_cast<size_t>(g)];
  if (p.data && p.step) return p.data;
  const Type type = global_info(g).type;
  p = {allocate(static_cast<size_t>(components(type)), pitch_), pitch_, 1, type, 0};
  return p.data;
}

void Grid::set_uniform(Global g, std::span<const float> value) {
  Type type = global_info(g).type;
  assert(value.size() == static_cast<size_t>(components(type)));
  float* data = allocate(value.size(), kMaxLanes);
  fill_uniform(data, value);
  globals_[static_cast<size_t>(g)] = {data, kMaxLanes, 0, type, 0};
}

float* Grid::add_varying_primvar(const std::string& name, Type type, uint32_t elements) {
  size_t planes = static_cast<size_t>(components(type)) * std::max(elements, 1u);
  Planes p{allocate(planes, pitch_), pitch_, 1, type, elements};
  std::fill_n(p.data, planes * pitch_, 0.0f);
  primvars_.emplace_back(name, p);
  return p.data;
}

void Grid::add_uniform_primvar(const std::string& name, const Value& value, StringPool& strings) {
  std::vector<float> numbers = value.numbers;
  for (const std::string& s : value.strings)
    numbers.push_back(std::bit_cast<float>(strings.intern(s)));
  Planes p{allocate(numbers.size(), kMaxLanes), kMaxLanes, 0, value.type, value.elements};
  fill_uniform(p.data, numbers);
  primvars_.emplace_back(name, p);
}

const Planes* Grid::primvar(const std::string& name) const {
  for (const auto& [n, p] : primvars_)
    if (n == name) return &p;
  return nullptr;
}

void Grid::reset(int nu, int nv) {
  assert(nu > 0 && nv > 0);
  nu_ = nu;
  nv_ = nv;
  pitch_ = padded(points());
  for (Planes& p : globals_)
    p = {};
  primvars_.clear();
  ray = {};
  lattice = Lattice::kRows;
  neighbours_end = false;
  std::fill_n(footprint, 4, nullptr);
  for (Block& b : blocks_)
    b.used = 0;
}

} // namespace slvm

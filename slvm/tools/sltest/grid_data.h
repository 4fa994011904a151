// The variables of a grid as copies outside any Machine: what a setup puts in, what a run leaves behind. From
// one GridData any number of Grids is filled, so that every run of a case starts from the same bits.
#pragma once

#include "slvm/grid.h"
#include "slvm/support/string_pool.h"

#include <string>
#include <string_view>
#include <vector>

namespace slvm::sltest {

/// One variable. Numbers lie plane after plane: plane k of point i is numbers[k * points + i]; a uniform one
/// has a single number a plane, and a string a text an element instead.
struct Variable {
  std::string name;
  Type type = Type::kFloat;
  uint32_t elements = 0;
  bool varying = false;
  std::vector<float> numbers;
  std::vector<std::string> strings;

  size_t planes() const { return static_cast<size_t>(components(type)) * (elements ? elements : 1); }
  size_t points() const { return varying ? numbers.size() / planes() : 1; }
  float get(size_t plane, size_t point) const {
    return varying ? numbers[plane * points() + point] : numbers[plane];
  }
  /// All numbers of one point.
  std::vector<float> at(size_t point) const;
};

Variable uniform_variable(std::string name, const Value& value);

struct GridData {
  int nu = 1, nv = 1;
  bool derivatives = true, flip_normals = false;
  RayFacts ray;
  Matrix4 object_to_current;
  std::vector<Variable> variables; ///< predefined ones by name, all others are primitive variables

  size_t points() const { return static_cast<size_t>(nu) * static_cast<size_t>(nv); }
  const Variable* find(std::string_view name) const;
  /// Replaces the variable of this name, or adds it.
  void set(Variable variable);
};

/// Fills an empty grid of the right size.
void fill(Grid& grid, const GridData& data, StringPool& strings);

/// A copy of what `planes` hold for the first `points` points.
Variable read(std::string name, const Planes& planes, size_t points, const StringPool& strings);

} // namespace slvm::sltest

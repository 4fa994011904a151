#include "slvm/tools/sltest/grid_data.h"

#include <algorithm>
#include <bit>

namespace slvm::sltest {

std::vector<float> Variable::at(size_t point) const {
  std::vector<float> result(numbers.empty() ? 0 : planes());
  for (size_t k = 0; k < result.size(); ++k)
    result[k] = get(k, point);
  return result;
}

Variable uniform_variable(std::string name, const Value& value) {
  return {std::move(name), value.type, value.elements, false, value.numbers, value.strings};
}

const Variable* GridData::find(std::string_view name) const {
  auto it =
      std::find_if(variables.begin(), variables.end(), [&](const Variable& v) { return v.name == name; });
  return it == variables.end() ? nullptr : &*it;
}

void GridData::set(Variable variable) {
  auto it = std::find_if(variables.begin(), variables.end(),
                         [&](const Variable& v) { return v.name == variable.name; });
  if (it == variables.end())
    variables.push_back(std::move(variable));
  else
    *it = std::move(variable);
}

namespace {

void copy_planes(float* to, size_t pitch, const Variable& v, size_t points) {
  for (size_t k = 0; k < v.planes(); ++k)
    std::copy_n(v.numbers.begin() + static_cast<ptrdiff_t>(k * points), points, to + k * pitch);
}

} // namespace

void fill(Grid& grid, const GridData& data, StringPool& strings) {
  grid.derivatives = data.derivatives;
  grid.flip_normals = data.flip_normals;
  grid.ray = data.ray;
  grid.object_to_current = data.object_to_current;
  for (const Variable& v : data.variables) {
    Global g = find_global(v.name);
    if (g != Global::kCount) {
      if (v.varying)
        copy_planes(grid.varying(g), grid.pitch(), v, data.points());
      else
        grid.set_uniform(g, v.numbers);
    } else if (v.varying) {
      copy_planes(grid.add_varying_primvar(v.name, v.type, v.elements), grid.pitch(), v, data.points());
    } else {
      grid.add_uniform_primvar(v.name, {v.type, v.elements, v.numbers, v.strings}, strings);
    }
  }
}

Variable read(std::string name, const Planes& planes, size_t points, const StringPool& strings) {
  Variable v{std::move(name), planes.type, planes.elements, planes.step != 0, {}, {}};
  const size_t count = v.varying ? points : 1;
  v.numbers.reserve(v.planes() * count);
  for (size_t k = 0; k < v.planes(); ++k)
    for (size_t i = 0; i < count; ++i)
      v.numbers.push_back(planes.get(k, i));
  if (v.type == Type::kString) {
    for (float id : v.numbers)
      v.strings.emplace_back(strings.text(std::bit_cast<uint32_t>(id)));
    v.numbers.clear();
  }
  return v;
}

} // namespace slvm::sltest

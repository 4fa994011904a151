#include "slvm/exec/query.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>

namespace slvm {

Query::Query(const GridCall& c, size_t name_operand)
    : call(c), run(c.run), found(c.operands[0].planes), out(c.operands[1]),
      before(c.operands[name_operand + 1]),
      name(run.state.machine.strings().text(std::bit_cast<uint32_t>(*c.operands[name_operand].planes.data))) {
}

void Query::copy(const Operand& from) const {
  const Operand& to = out.planes;
  size_t lanes = to.step ? run.pitch : kMaxLanes;
  for (size_t i = 0; i < planes(); ++i) {
    if (from.step && to.step)
      std::memmove(to.plane(i), from.plane(i), lanes * sizeof(float));
    else
      std::fill_n(to.plane(i), lanes, *from.plane(i));
  }
}

void Query::not_found() const {
  result(false);
  if (!out.array && out.planes.data != before.planes.data) copy(before.planes);
}

void Query::wrong_type(Type type, uint32_t other_elements) const {
  run.report(call.code, MessageSeverity::kError,
             fmt::format("{} \"{}\" is a {}, not a {}", call.info.name, name, describe(type, other_elements),
                         describe(out.type, elements())),
             run.points);
  not_found();
}

void Query::give(const Operand& from) const {
  copy(from);
  result(true);
}

void Query::give(const Value& value) const {
  if (value.type != out.type || value.elements != elements()) return wrong_type(value.type, value.elements);
  std::vector<float> numbers = value.numbers;
  for (const std::string& s : value.strings)
    numbers.push_back(std::bit_cast<float>(run.state.machine.strings().intern(s)));
  size_t lanes = out.planes.step ? run.pitch : kMaxLanes;
  for (size_t i = 0; i < planes() && i < numbers.size(); ++i)
    std::fill_n(out.planes.plane(i), lanes, numbers[i]);
  result(true);
}

std::string describe(Type type, uint32_t elements) {
  return elements ? fmt::format("{}[{}]", type_name(type), elements) : std::string(type_name(type));
}

} // namespace slvm

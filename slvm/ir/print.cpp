// IR as text.
#include "slvm/ir/print.h"

#include <fmt/format.h>
#include <map>

namespace slvm::ir {
namespace {

class Printer {
public:
  explicit Printer(const Module& m) : m_(m) {}

  std::string run() {
    out_ = fmt::format("{} {}\n", shader_kind_name(m_.kind), m_.name);
    for (const Param& p : m_.params) {
      if (p.init < 0) continue;
      out_ += fmt::format("default {}\n", p.name);
      region(m_.inits[static_cast<size_t>(p.init)], 1);
    }
    out_ += "body\n";
    region(m_.body, 1);
    return std::move(out_);
  }

private:
  // Values are numbered in the order they appear, so that the text of equal code is equal.
  std::string value(ValueId v) {
    auto [it, added] = names_.try_emplace(v, names_.size());
    return fmt::format("%{}", it->second);
  }
  std::string values(const std::vector<ValueId>& list) {
    std::string out;
    for (ValueId v : list)
      out += (out.empty() ? "" : ", ") + value(v);
    return out;
  }
  std::string typed(const std::vector<ValueId>& list) {
    std::string out;
    for (ValueId v : list)
      out += fmt::format("{}{}: {}{}", out.empty() ? "" : ", ", value(v), m_.varying(v) ? "varying " : "",
                         type_name(m_.type(v)));
    return out;
  }

  std::string subject(const Inst& inst) {
    switch (inst.op) {
    case Op::kConstant: {
      const Constant& c = m_.constants[inst.index];
      if (c.type == Type::kString) return fmt::format(" \"{}\"", c.text);
      if (c.type == Type::kBool) return c.numbers[0] == 0 ? " false" : " true";
      std::string out;
      for (float x : c.numbers)
        out += fmt::format(" {}", x);
      return out;
    }
    case Op::kSlot:
    case Op::kStore: return " " + m_.slots[inst.index].name;
    case Op::kGather:
      // Its own name says which row it is, except for traverse.
      return m_.called(inst).name == "traverse" ? " traverse" : "";
    case Op::kCall: return fmt::format(" {}", m_.called(inst).name);
    case Op::kArray:
    case Op::kArrayClear:
    case Op::kArrayLoad:
    case Op::kArrayStore: return fmt::format(" @{}", inst.index);
    case Op::kBreak:
    case Op::kContinue: return fmt::format(" {}", inst.index);
    default: return "";
    }
  }

  void region(const Region& r, int indent) {
    for (InstId id : r.body) {
      const Inst& inst = m_.insts[id];
      std::string args = values(inst.args);
      std::string results = typed(inst.results);
      out_ += std::string(static_cast<size_t>(indent) * 2, ' ');
      if (!results.empty()) out_ += results + " = ";
      out_ += op_name(inst.op);
      out_ += subject(inst);
      if (!args.empty()) out_ += " " + args;
      for (size_t i = 0; i < inst.regions.size(); ++i) {
        if (i == 0)
          out_ += inst.regions[i].params.empty()
                      ? " {\n"
                      : fmt::format(" -> ({}) {{\n", typed(inst.regions[i].params));
        else
          out_ += std::string(static_cast<size_t>(indent) * 2, ' ') + "} else {\n";
        region(inst.regions[i], indent + 1);
      }
      if (!inst.regions.empty()) out_ += std::string(static_cast<size_t>(indent) * 2, ' ') + "}";
      out_ += '\n';
    }
  }

  const Module& m_;
  std::map<ValueId, size_t> names_;
  std::string out_;
};

} // namespace

std::string print(const Module& m) {
  return Printer(m).run();
}

} // namespace slvm::ir

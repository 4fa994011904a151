// Small modules that between them use every instruction, for the tests of IR, bytecode and files.
#pragma once

#include "slvm/ir/build.h"

#include <string>
#include <vector>

namespace slvm::ir {

/// A module being made: slots by name, regions filled by functions.
class Sketch {
public:
  explicit Sketch(ShaderKind kind = ShaderKind::kSurface, std::string name = "sample");

  /// The slot of a predefined variable, added when it is not there yet.
  uint32_t global(const std::string& name);
  /// Adds a parameter whose default is `numbers`.
  uint32_t param(const std::string& name, Type type, std::vector<float> numbers, bool varying = false);

  ValueId read(const std::string& name) { return b.slot(global(name)); }
  void store(const std::string& name, ValueId value) { b.store(global(name), value); }
  ValueId number(float x) { return b.number(x); }
  ValueId binary(const std::string& op, const std::string& types, ValueId x, ValueId y);
  ValueId add(ValueId x, ValueId y) { return binary("operator+", "float(float a, float b)", x, y); }
  ValueId multiply(ValueId x, ValueId y) { return binary("operator*", "float(float a, float b)", x, y); }
  ValueId less(ValueId x, ValueId y) { return binary("operator<", "bool(float a, float b)", x, y); }

  /// A region filled by `body`, which gets its parameters.
  template <class F> Region region(std::vector<Type> params, F&& body) {
    Region r;
    for (Type t : params)
      r.params.push_back(b.new_value(t));
    Region* outer = b.region();
    b.set_region(&r);
    body(r.params);
    b.set_region(outer);
    return r;
  }
  template <class Then, class Else>
  std::vector<ValueId> branch(ValueId condition, std::vector<Type> results, Then&& then, Else&& otherwise) {
    std::vector<Region> regions;
    regions.push_back(region({}, [&](auto&) { then(); }));
    regions.push_back(region({}, [&](auto&) { otherwise(); }));
    return m.insts[b.region_inst(Op::kIf, 0, {condition}, std::move(regions), results)].results;
  }
  template <class F> std::vector<ValueId> loop(std::vector<ValueId> initial, F&& body) {
    std::vector<Type> types;
    for (ValueId v : initial)
      types.push_back(m.type(v));
    std::vector<Region> regions;
    regions.push_back(region(types, body));
    return m.insts[b.region_inst(Op::kLoop, 0, std::move(initial), std::move(regions), types)].results;
  }
  /// A loop over all lights in the half space of N around P.
  template <class F> std::vector<ValueId> light_loop(std::vector<ValueId> initial, F&& body) {
    std::vector<Type> types;
    for (ValueId v : initial)
      types.push_back(m.type(v));
    std::vector<ValueId> args{b.string(""), read("P"), b.retype(Type::kVector, read("N")), number(1.57f)};
    args.insert(args.end(), initial.begin(), initial.end());
    std::vector<Region> regions;
    regions.push_back(region(types, body));
    return m.insts[b.region_inst(Op::kIlluminance, 1, std::move(args), std::move(regions), types)].results;
  }
  /// Ends the body; the module is complete.
  Module finish();

  Module m;
  Builder b{m};
};

/// Optimises, emits.
Program compile(Module m, int level = 2);

/// All samples: name, module.
std::vector<std::pair<std::string, Module>> samples();

Module gather_loop();    ///< a loop over rays with an output, a break and both blocks
Module arithmetic();     ///< straight-line code with constants and a retype
Module varying_branch(); ///< an if whose branches store and yield
Module while_loop();     ///< while (x < 8) x += x
Module nested_exits();   ///< break 2 and continue 1 out of nested loops and a block
Module array_sum();      ///< an array filled and summed in loops
Module illuminance_loop();
Module cone_light(); ///< illuminate and solar
Module computed_default();
Module messages(); ///< printf, a derivative, an output argument

} // namespace slvm::ir

// The sample modules, each the IR of a few lines of RSL.
#include "tests/unit/ir/samples.h"

#include "slvm/ir/emit.h"
#include "slvm/ir/passes/passes.h"
#include "slvm/ir/serialise.h"

#include <cassert>

namespace slvm::ir {

Sketch::Sketch(ShaderKind kind, std::string name) {
  m.kind = kind;
  m.name = std::move(name);
  m.files = {"", "sample.sl"};
  b.where = {1, 1, 1, 2};
  b.set_region(&m.body);
}

uint32_t Sketch::global(const std::string& name) {
  for (uint32_t i = 0; i < m.slots.size(); ++i)
    if (m.slots[i].name == name) return i;
  Global g = find_global(name);
  assert(g != Global::kCount);
  m.slots.push_back({name, global_info(g).type, 0, false, global_info(g).detail == Detail::kVarying, false});
  return static_cast<uint32_t>(m.slots.size() - 1);
}

uint32_t Sketch::param(const std::string& name, Type type, std::vector<float> numbers, bool varying) {
  Param p;
  p.name = name;
  p.type = type;
  p.varying = varying;
  p.default_known = true;
  p.default_value = {type, 0, std::move(numbers), {}};
  p.slot = static_cast<int32_t>(m.slots.size());
  m.params.push_back(p);
  m.slots.push_back({name, type, 0, true, varying, false});
  return static_cast<uint32_t>(p.slot);
}

ValueId Sketch::binary(const std::string& op, const std::string& types, ValueId x, ValueId y) {
  ++b.where.line; // so that line tables have something to tell
  return b.call(op, types, {x, y});
}

Module Sketch::finish() {
  b.yield({});
  return std::move(m);
}

Program compile(Module m, int level) {
  optimise(m, level, nullptr);
  Program program;
  program.kind = m.kind;
  program.name = m.name;
  emit(m, program);
  program.ir = serialise(m);
  return program;
}

Module arithmetic() {
  Sketch s;
  uint32_t kd = s.param("Kd", Type::kFloat, {0.5f});
  ValueId three = s.add(s.number(1), s.number(2));
  ValueId scaled = s.multiply(s.b.slot(kd), three);
  ValueId normal = s.b.retype(Type::kColor, s.read("N"));
  s.store("Ci", s.binary("operator*", "color(color a, float b)", normal, scaled));
  s.store("Oi", s.read("Os"));
  return s.finish();
}

Module varying_branch() {
  Sketch s;
  auto merged = s.branch(
      s.less(s.read("s"), s.number(0.5f)), {Type::kFloat},
      [&] {
        s.store("Oi", s.read("Os"));
        s.b.yield({s.multiply(s.read("s"), s.number(2))});
      },
      [&] { s.b.yield({s.number(1)}); });
  s.store("Ci", s.b.call("convert", "color(float x)", {merged[0]}));
  return s.finish();
}

Module while_loop() {
  Sketch s;
  auto x = s.loop({s.read("s")}, [&](const std::vector<ValueId>& carried) {
    ValueId limit = s.number(8);
    s.branch(
        s.less(carried[0], limit), {}, [&] { s.b.yield({}); }, [&] { s.b.break_out(0, {carried[0]}); });
    s.b.next_round(0, {s.add(carried[0], carried[0])});
  });
  s.store("Ci", s.b.call("convert", "color(float x)", {x[0]}));
  return s.finish();
}

Module nested_exits() {
  Sketch s;
  auto sum = s.loop({s.number(0)}, [&](const std::vector<ValueId>& outer) {
    auto inner = s.loop({outer[0]}, [&](const std::vector<ValueId>& carried) {
      ValueId next = s.add(carried[0], s.read("s"));
      s.branch(
          s.less(next, s.number(3)), {}, [&] { s.b.next_round(1, {next}); },
          [&] {
            s.branch(
                s.less(next, s.number(5)), {}, [&] { s.b.yield({}); }, [&] { s.b.break_out(1, {next}); });
            s.b.yield({});
          });
      s.b.break_out(0, {s.add(next, s.number(1))});
    });
    std::vector<Region> block;
    block.push_back(s.region({}, [&](auto&) {
      s.branch(
          s.less(s.read("t"), inner[0]), {}, [&] { s.b.break_out(0, {inner[0]}); }, [&] { s.b.yield({}); });
      s.b.break_out(0, {s.multiply(inner[0], inner[0])});
    }));
    Type type = Type::kFloat;
    InstId id = s.b.region_inst(Op::kBlock, 0, {}, std::move(block), std::span(&type, 1));
    s.b.next_round(0, {s.m.insts[id].results[0]});
  });
  s.store("Ci", s.b.call("convert", "color(float x)", {sum[0]}));
  return s.finish();
}

Module array_sum() {
  Sketch s;
  uint32_t array = s.b.add_array(Type::kFloat, 4);
  s.b.array_clear(array);
  for (int i = 0; i < 3; ++i)
    s.b.array_store(array, s.number(static_cast<float>(i)),
                    s.multiply(s.read("s"), s.number(static_cast<float>(i))));
  auto sum = s.loop({s.number(0), s.number(0)}, [&](const std::vector<ValueId>& carried) {
    s.branch(
        s.less(carried[0], s.number(4)), {}, [&] { s.b.yield({}); },
        [&] {
          s.b.break_out(0, {carried[0], carried[1]});
        });
    ValueId total = s.add(carried[1], s.b.array_load(array, carried[0]));
    s.b.next_round(0, {s.add(carried[0], s.number(1)), total});
  });
  ValueId length = s.b.call("arraylength", "uniform float(float[] a)", {s.b.array(array)});
  s.store("Ci", s.b.call("convert", "color(float x)", {s.multiply(sum[1], length)}));
  return s.finish();
}

Module illuminance_loop() {
  Sketch s;
  ValueId n = s.b.retype(Type::kVector, s.b.call("normalize", "normal(normal v)", {s.read("N")}));
  std::vector<ValueId> args{s.b.string(""), s.read("P"), n, s.number(1.57f),
                            s.b.triple(Type::kColor, 0, 0, 0)};
  std::vector<Region> body;
  body.push_back(s.region({Type::kColor}, [&](const std::vector<ValueId>& carried) {
    ValueId cosine = s.b.call("operator.", "float(vector a, vector b)", {s.read("L"), n});
    ValueId term = s.binary("operator*", "color(color a, float b)", s.read("Cl"), cosine);
    s.b.next_round(0, {s.binary("operator+", "color(color a, color b)", carried[0], term)});
  }));
  Type type = Type::kColor;
  InstId id = s.b.region_inst(Op::kIlluminance, 1, std::move(args), std::move(body), std::span(&type, 1));
  s.store("Ci", s.m.insts[id].results[0]);
  return s.finish();
}

Module gather_loop() {
  Sketch s;
  ValueId n = s.b.retype(Type::kVector, s.read("N"));
  std::vector<ValueId> args{s.b.string(""),
                            s.read("P"),
                            n,
                            s.number(1.5f),
                            s.number(16),
                            s.b.string("surface:Ci"),
                            s.b.triple(Type::kColor, 0, 0, 0),
                            s.number(0)};
  std::vector<Region> body;
  body.push_back(s.region({Type::kFloat}, [&](const std::vector<ValueId>& carried) {
    const Type boolean = Type::kBool, colour = Type::kColor;
    ValueId hit = s.b.call(shadeop_overloads("gatherhit")[0], {}, std::span(&boolean, 1))[0];
    std::vector<ValueId> asked{s.b.string("surface:Ci"), s.b.triple(Type::kColor, 0, 0, 0)};
    ValueId seen = s.b.call(shadeop_overloads("gathered")[0], asked, std::span(&colour, 1))[0];
    std::vector<ValueId> sum = s.branch(
        hit, {Type::kFloat},
        [&] {
          ValueId red = s.b.call("comp", "float(color c, float i)", {seen, s.number(0)});
          s.b.yield({s.add(carried[0], red)});
        },
        [&] { s.b.break_out(0, {carried[0]}); });
    s.b.next_round(0, {sum[0]});
  }));
  const Type type = Type::kFloat;
  InstId id = s.b.region_inst(Op::kGather, shadeop_overloads("gather")[0], std::move(args), std::move(body),
                              std::span(&type, 1));
  s.store("Ci", s.b.call("convert", "color(float x)", {s.m.insts[id].results[0]}));
  return s.finish();
}

Module cone_light() {
  Sketch s(ShaderKind::kLight, "cone");
  for (const char* name : {"L", "Ps", "Ns"})
    s.global(name); // what light statements set and test
  uint32_t intensity = s.param("intensity", Type::kFloat, {1});
  uint32_t from = s.param("from", Type::kPoint, {0, 0, 0});
  auto emit_light = [&] {
    ValueId white = s.b.triple(Type::kColor, 1, 1, 1);
    s.store("Cl", s.binary("operator*", "color(color a, float b)", white, s.b.slot(intensity)));
    s.b.yield({});
  };
  ValueId axis = s.b.triple(Type::kVector, 0, 0, 1);
  std::vector<Region> cone, parallel;
  cone.push_back(s.region({}, [&](auto&) { emit_light(); }));
  s.b.region_inst(Op::kIlluminate, 1, {s.b.slot(from), axis, s.number(0.5f)}, std::move(cone), {});
  parallel.push_back(s.region({}, [&](auto&) { emit_light(); }));
  s.b.region_inst(Op::kSolar, 0, {axis, s.number(0)}, std::move(parallel), {});
  return s.finish();
}

Module computed_default() {
  Sketch s;
  uint32_t scale = s.param("scale", Type::kFloat, {}, true);
  s.m.params[0].default_known = false;
  s.m.params[0].init = 0;
  s.m.slots[scale].stored = true;
  s.m.inits.push_back(s.region({}, [&](auto&) { s.b.yield({s.add(s.number(1), s.read("s"))}); }));
  s.store("Ci", s.b.call("convert", "color(float x)", {s.b.slot(scale)}));
  return s.finish();
}

Module messages() {
  Sketch s(ShaderKind::kSurface, "messages");
  auto id = static_cast<ShadeopId>(find_shadeop("printf", "void(uniform string pattern, any values...)"));
  std::vector<ValueId> values{s.b.string("%f %p\n"), s.read("s"), s.read("P")};
  s.b.call(id, values, {});
  ValueId slope = s.b.call("Du", "float(float x)", {s.multiply(s.read("s"), s.read("t"))});
  auto query = static_cast<ShadeopId>(
      find_shadeop("displacement", "uniform float(uniform string name, inout any value)"));
  std::vector<ValueId> asked{s.b.string("bump"), slope};
  Type results[] = {Type::kFloat, Type::kFloat};
  auto answer = s.b.call(query, asked, results);
  s.store("Ci", s.b.call("convert", "color(float x)", {s.add(answer[0], answer[1])}));
  return s.finish();
}

std::vector<std::pair<std::string, Module>> samples() {
  std::vector<std::pair<std::string, Module>> list;
  list.emplace_back("arithmetic", arithmetic());
  list.emplace_back("varying_branch", varying_branch());
  list.emplace_back("while_loop", while_loop());
  list.emplace_back("nested_exits", nested_exits());
  list.emplace_back("array_sum", array_sum());
  list.emplace_back("illuminance_loop", illuminance_loop());
  list.emplace_back("gather_loop", gather_loop());
  list.emplace_back("cone_light", cone_light());
  list.emplace_back("computed_default", computed_default());
  list.emplace_back("messages", messages());
  return list;
}

} // namespace slvm::ir

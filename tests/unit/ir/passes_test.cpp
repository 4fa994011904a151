// Each pass on a module made for it: the text of the body before and after.
#include "slvm/ir/passes/passes.h"

#include "slvm/ir/print.h"
#include "slvm/ir/verify_ir.h"
#include "tests/unit/ir/samples.h"

#include <gtest/gtest.h>

namespace slvm::ir {
namespace {

std::string body(const Module& m) {
  EXPECT_EQ(verify_module(m), "");
  std::string text = print(m);
  return text.substr(text.find("body\n") + 5);
}

/// Knows sums and products of floats.
class Adder : public ConstantEvaluator {
public:
  bool evaluate(ShadeopId id, std::span<const Constant* const> args,
                std::vector<Constant>& results) const override {
    std::string_view name = shadeop(id).name;
    if (args.size() != 2 || args[0]->type != Type::kFloat || args[1]->type != Type::kFloat) return false;
    float a = args[0]->numbers[0], b = args[1]->numbers[0];
    if (name != "operator+" && name != "operator*") return false;
    results.push_back({Type::kFloat, {name == "operator+" ? a + b : a * b}, {}});
    return true;
  }
};

TEST(FoldConstants, ComputesCallsOfConstants) {
  Sketch s;
  ValueId x = s.multiply(s.add(s.number(1), s.number(2)), s.number(4));
  s.store("Ci", s.b.call("convert", "color(float x)", {x}));
  Module m = s.finish();
  Adder adder;
  EXPECT_TRUE(fold_constants(m, &adder));
  remove_dead(m);
  EXPECT_EQ(body(m), "  %0: float = constant 12\n  %1: color = call convert %0\n  store Ci %1\n  yield\n");
}

TEST(FoldConstants, WithoutEvaluatorOnlyIdentities) {
  Sketch s;
  ValueId x = s.multiply(s.read("s"), s.number(1));
  ValueId y = s.add(x, s.number(0)); // stays: -0 + 0 is 0
  s.store("Ci", s.b.call("convert", "color(float x)", {y}));
  Module m = s.finish();
  EXPECT_TRUE(fold_constants(m, nullptr));
  remove_dead(m);
  EXPECT_EQ(body(m), "  %0: float = slot s\n  %1: float = constant 0\n  %2: float = call operator+ %0, %1\n"
                     "  %3: color = call convert %2\n  store Ci %3\n  yield\n");
}

TEST(FoldConstants, TakesTheBranchOfAConstantCondition) {
  Sketch s;
  ValueId yes = s.b.constant({Type::kBool, {1}, {}});
  auto x = s.branch(
      yes, {Type::kFloat}, [&] { s.b.yield({s.read("s")}); },
      [&] {
        s.store("Oi", s.read("Os"));
        s.b.yield({s.read("t")});
      });
  s.store("Ci", s.b.call("convert", "color(float x)", {x[0]}));
  Module m = s.finish();
  EXPECT_TRUE(fold_constants(m, nullptr));
  remove_dead(m);
  EXPECT_EQ(body(m), "  %0: float = slot s\n  %1: color = call convert %0\n  store Ci %1\n  yield\n");
}

TEST(FoldConstants, NothingFollowsAnExitTakenForCertain) {
  Sketch s;
  auto x = s.loop({s.read("s")}, [&](const std::vector<ValueId>& carried) {
    ValueId no = s.b.constant({Type::kBool, {0}, {}});
    s.branch(
        no, {}, [&] { s.b.yield({}); }, [&] { s.b.break_out(0, {carried[0]}); });
    s.b.next_round(0, {s.add(carried[0], carried[0])});
  });
  s.store("Ci", s.b.call("convert", "color(float x)", {x[0]}));
  Module m = s.finish();
  EXPECT_TRUE(fold_constants(m, nullptr));
  remove_dead(m);
  EXPECT_EQ(body(m), "  %0: float = slot s\n  %1: float = loop %0 -> (%2: float) {\n    break 0 %2\n  }\n"
                     "  %3: color = call convert %1\n  store Ci %3\n  yield\n");
}

TEST(PropagateCopies, DropsWhatALoopOnlyPassesOn) {
  Sketch s;
  auto out = s.loop({s.read("s"), s.read("t")}, [&](const std::vector<ValueId>& carried) {
    s.branch(
        s.less(carried[0], s.number(2)), {}, [&] { s.b.yield({}); }, [&] { s.b.break_out(0, carried); });
    s.b.next_round(0, {s.add(carried[0], carried[1]), carried[1]});
  });
  s.store("Ci", s.b.call("triple", "color(float a, float b, float c)", {out[0], out[1], out[1]}));
  Module m = s.finish();
  EXPECT_TRUE(propagate_copies(m));
  EXPECT_EQ(
      body(m),
      "  %0: float = slot s\n  %1: float = slot t\n  %2: float = loop %0 -> (%3: float) {\n"
      "    %4: float = constant 2\n    %5: bool = call operator< %3, %4\n    if %5 {\n      yield\n"
      "    } else {\n      break 0 %3\n    }\n    %6: float = call operator+ %3, %1\n    continue 0 %6\n  }\n"
      "  %7: color = call triple %2, %1, %1\n  store Ci %7\n  yield\n");
}

TEST(PropagateCopies, DropsResultsOnWhichBothBranchesAgree) {
  Sketch s;
  ValueId x = s.read("s");
  auto out = s.branch(
      s.less(x, s.number(2)), {Type::kFloat},
      [&] {
        s.store("Oi", s.read("Os"));
        s.b.yield({x});
      },
      [&] { s.b.yield({x}); });
  s.store("Ci", s.b.call("convert", "color(float x)", {out[0]}));
  Module m = s.finish();
  EXPECT_TRUE(propagate_copies(m));
  EXPECT_EQ(body(m),
            "  %0: float = slot s\n  %1: float = constant 2\n  %2: bool = call operator< %0, %1\n  if %2 {\n"
            "    %3: color = slot Os\n    store Oi %3\n    yield\n  } else {\n    yield\n  }\n"
            "  %4: color = call convert %0\n  store Ci %4\n  yield\n");
}

TEST(MergeCommon, EqualComputationsBecomeOne) {
  Sketch s;
  ValueId a = s.multiply(s.read("s"), s.read("t"));
  ValueId b = s.multiply(s.read("s"), s.read("t"));
  s.store("Ci", s.b.call("convert", "color(float x)", {s.add(a, b)}));
  Module m = s.finish();
  EXPECT_TRUE(merge_common(m));
  EXPECT_EQ(body(m),
            "  %0: float = slot t\n  %1: float = slot s\n  %2: float = call operator* %1, %0\n"
            "  %3: float = call operator+ %2, %2\n  %4: color = call convert %3\n  store Ci %4\n  yield\n");
}

TEST(MergeCommon, ReadsStayBehindWrites) {
  Sketch s;
  ValueId before = s.read("P");
  s.store("P", s.read("E"));
  ValueId after = s.read("P");
  s.store("Ci", s.b.retype(Type::kColor, s.binary("operator-", "vector(point a, point b)", before, after)));
  Module m = s.finish();
  merge_common(m);
  EXPECT_EQ(body(m),
            "  %0: point = slot P\n  %1: point = slot E\n  store P %1\n  %2: point = slot P\n"
            "  %3: vector = call operator- %0, %2\n  %4: color = retype %3\n  store Ci %4\n  yield\n");
}

TEST(MergeCommon, LightColourOfTwoLoopsIsNotTheSame) {
  Sketch s;
  for (int i = 0; i < 2; ++i) {
    std::vector<ValueId> args{s.b.string(""), s.read("P"), s.b.retype(Type::kVector, s.read("N")),
                              s.number(1), s.b.triple(Type::kColor, 0, 0, 0)};
    std::vector<Region> loop;
    loop.push_back(s.region({Type::kColor}, [&](const std::vector<ValueId>& carried) {
      s.b.next_round(0, {s.binary("operator+", "color(color a, color b)", carried[0], s.read("Cl"))});
    }));
    Type type = Type::kColor;
    InstId id = s.b.region_inst(Op::kIlluminance, 1, std::move(args), std::move(loop), std::span(&type, 1));
    s.store("Ci", s.m.insts[id].results[0]);
  }
  Module m = s.finish();
  merge_common(m);
  std::string text = body(m);
  size_t reads = 0;
  for (size_t at = text.find("slot Cl"); at != text.npos; at = text.find("slot Cl", at + 1))
    ++reads;
  EXPECT_EQ(reads, 2u);
}

TEST(RemoveDead, UnusedComputationsGoEffectsStay) {
  Sketch s;
  s.add(s.read("s"), s.number(1));
  auto id = static_cast<ShadeopId>(find_shadeop("printf", "void(uniform string pattern)"));
  ValueId text[] = {s.b.string("here")};
  s.b.call(id, text, {});
  s.store("Oi", s.read("Os"));
  Module m = s.finish();
  EXPECT_TRUE(remove_dead(m));
  EXPECT_EQ(
      body(m),
      "  %0: string = constant \"here\"\n  call printf %0\n  %1: color = slot Os\n  store Oi %1\n  yield\n");
}

TEST(RemoveDead, ACounterThatOnlyCountsItselfGoes) {
  Sketch s;
  auto out = s.loop({s.read("s"), s.number(0)}, [&](const std::vector<ValueId>& carried) {
    s.branch(
        s.less(carried[0], s.number(2)), {}, [&] { s.b.yield({}); }, [&] { s.b.break_out(0, carried); });
    s.b.next_round(0, {s.add(carried[0], carried[0]), s.add(carried[1], s.number(1))});
  });
  s.store("Ci", s.b.call("convert", "color(float x)", {out[0]}));
  Module m = s.finish();
  EXPECT_TRUE(remove_dead(m));
  EXPECT_EQ(body(m).find("constant 1"), std::string::npos);
  EXPECT_NE(body(m).find("loop %0 -> (%2: float)"), std::string::npos) << body(m);
}

TEST(RemoveDead, ArraysNobodyReadsGo) {
  Sketch s;
  uint32_t array = s.b.add_array(Type::kFloat, 4);
  s.b.array_store(array, s.number(0), s.read("s"));
  s.store("Oi", s.read("Os"));
  Module m = s.finish();
  EXPECT_TRUE(remove_dead(m));
  EXPECT_EQ(body(m), "  %0: color = slot Os\n  store Oi %0\n  yield\n");
}

TEST(HoistInvariants, MovesOutOfAllLoopsItDoesNotDependOn) {
  Sketch s;
  auto out = s.loop({s.read("s")}, [&](const std::vector<ValueId>& outer) {
    auto inner = s.loop({outer[0]}, [&](const std::vector<ValueId>& carried) {
      ValueId invariant = s.multiply(s.read("t"), s.number(3));
      ValueId of_outer = s.multiply(outer[0], s.number(3));
      s.b.break_out(0, {s.add(s.add(invariant, of_outer), carried[0])});
    });
    s.b.break_out(0, {inner[0]});
  });
  s.store("Ci", s.b.call("convert", "color(float x)", {out[0]}));
  Module m = s.finish();
  EXPECT_TRUE(hoist_invariants(m));
  merge_common(m);
  EXPECT_EQ(body(m),
            "  %0: float = slot s\n  %1: float = constant 3\n  %2: float = slot t\n  %3: float = call "
            "operator* %2, %1\n"
            "  %4: float = loop %0 -> (%5: float) {\n    %6: float = call operator* %5, %1\n"
            "    %7: float = call operator+ %3, %6\n    %8: float = loop %5 -> (%9: float) {\n"
            "      %10: float = call operator+ %7, %9\n      break 0 %10\n    }\n    break 0 %8\n  }\n"
            "  %11: color = call convert %4\n  store Ci %11\n  yield\n");
}

TEST(HoistInvariants, LeavesReadsOfLightsWhereTheyAre) {
  Module m = illuminance_loop();
  hoist_invariants(m);
  std::string text = body(m);
  EXPECT_GT(text.find("slot Cl"), text.find("illuminance"));
  EXPECT_GT(text.find("slot L"), text.find("illuminance"));
}

TEST(SelectSmallIfs, CheapBranchesBecomeASelection) {
  Sketch s;
  auto out = s.branch(
      s.less(s.read("s"), s.number(2)), {Type::kFloat}, [&] { s.b.yield({s.number(1)}); },
      [&] { s.b.yield({s.add(s.read("t"), s.number(5))}); });
  s.store("Ci", s.b.call("convert", "color(float x)", {out[0]}));
  Module m = s.finish();
  EXPECT_TRUE(select_small_ifs(m));
  EXPECT_EQ(
      body(m),
      "  %0: float = constant 2\n  %1: float = slot s\n  %2: bool = call operator< %1, %0\n  %3: float = "
      "constant 1\n"
      "  %4: float = constant 5\n  %5: float = slot t\n  %6: float = call operator+ %5, %4\n"
      "  %7: float = call operator?: %2, %3, %6\n  %8: color = call convert %7\n  store Ci %8\n  yield\n");
}

// Two light loops; `between` gets the first one's result and gives the second one's initial value.
template <class Between, class Body> Module two_light_loops(Between&& between, Body&& second_body) {
  Sketch s;
  ValueId zero = s.b.triple(Type::kColor, 0, 0, 0);
  auto total = [&](ValueId carried) {
    return s.binary("operator+", "color(color a, color b)", carried, s.read("Cl"));
  };
  auto first = s.light_loop({zero}, [&](auto& carried) { s.b.next_round(0, {total(carried[0])}); });
  auto second =
      s.light_loop({between(s, first[0])}, [&](auto& carried) { second_body(s, total(carried[0])); });
  s.store("Ci", s.binary("operator*", "color(color a, color b)", first[0], second[0]));
  Module m = s.finish();
  merge_common(m);
  return m;
}
ValueId scaled(Sketch& s, ValueId v) {
  return s.binary("operator*", "color(color a, float b)", v, s.read("t"));
}
void next_round(Sketch& s, ValueId carried) {
  s.b.next_round(0, {carried});
}
size_t light_loops(const Module& m) {
  size_t count = 0;
  for (InstId id : m.body.body)
    count += m.insts[id].op == Op::kIlluminance;
  return count;
}

TEST(MergeLightLoops, OneLoopDoesTheWorkOfTwo) {
  Module m = two_light_loops([](Sketch& s, ValueId) { return scaled(s, s.read("Os")); }, next_round);
  EXPECT_TRUE(merge_light_loops(m));
  std::string text = body(m);
  EXPECT_EQ(light_loops(m), 1u) << text;
  EXPECT_NE(text.find("%9: color, %10: color = illuminance"), std::string::npos) << text;
  EXPECT_FALSE(merge_light_loops(m));
}

TEST(MergeLightLoops, NotWhenTheSecondNeedsTheFirst) {
  Module chained = two_light_loops([](Sketch& s, ValueId first) { return scaled(s, first); }, next_round);
  EXPECT_FALSE(merge_light_loops(chained));
  Module captured;
  ValueId of_first = kNoValue;
  captured = two_light_loops(
      [&](Sketch& s, ValueId first) {
        of_first = first;
        return s.read("Os");
      },
      [&](Sketch& s, ValueId total) {
        next_round(s, s.binary("operator*", "color(color a, color b)", total, of_first));
      });
  EXPECT_FALSE(merge_light_loops(captured));
}

TEST(MergeLightLoops, NotAcrossStores) {
  Module m = two_light_loops(
      [](Sketch& s, ValueId) {
        s.store("Oi", s.read("Os"));
        return s.read("Os");
      },
      next_round);
  EXPECT_FALSE(merge_light_loops(m));
}

TEST(MergeLightLoops, NotWhenLanesLeaveEarly) {
  Module m = two_light_loops([](Sketch& s, ValueId) { return s.read("Os"); },
                             [](Sketch& s, ValueId total) {
                               s.branch(
                                   s.less(s.read("s"), s.number(2)), {}, [&] { s.b.yield({}); },
                                   [&] { s.b.break_out(0, {total}); });
                               next_round(s, total);
                             });
  EXPECT_FALSE(merge_light_loops(m));
}

std::string reduced_power(float exponent) {
  Sketch s;
  ValueId power = s.b.call("pow", "float(float x, float y)", {s.read("s"), s.number(exponent)});
  s.store("Ci", s.b.call("convert", "color(float x)", {power}));
  Module m = s.finish();
  bool changed = reduce_strength(m);
  remove_dead(m);
  std::string text = body(m);
  return changed ? text.substr(0, text.find("convert")) : "";
}

TEST(ReduceStrength, SquaresAndRootsAreNoPowers) {
  EXPECT_EQ(reduced_power(2),
            "  %0: float = slot s\n  %1: float = call operator* %0, %0\n  %2: color = call ");
  EXPECT_EQ(reduced_power(0.5f), "  %0: float = slot s\n  %1: float = call sqrt %0\n  %2: color = call ");
  EXPECT_EQ(reduced_power(3), ""); // x * x * x is rounded twice
  EXPECT_EQ(reduced_power(-1), "");
}

TEST(ReduceStrength, FloatsNeedNotBeSpread) {
  Sketch s;
  ValueId grey = s.b.call("convert", "color(float x)", {s.read("s")});
  ValueId left = s.binary("operator*", "color(color a, color b)", grey, s.read("Cs"));
  ValueId right = s.binary("operator*", "color(color a, color b)", left, grey);
  s.store("Ci", s.binary("operator/", "color(color a, color b)", right, grey));
  Module m = s.finish();
  EXPECT_TRUE(reduce_strength(m));
  remove_dead(m);
  EXPECT_EQ(
      body(m),
      "  %0: float = slot s\n  %1: color = slot Cs\n  %2: color = call operator* %0, %1\n"
      "  %3: color = call operator* %2, %0\n  %4: color = call operator/ %3, %0\n  store Ci %4\n  yield\n");
  EXPECT_FALSE(reduce_strength(m));
}

TEST(SelectSmallIfs, KeepsBranchesWithEffectsOrCostlyCalls) {
  Module stores = varying_branch();
  EXPECT_FALSE(select_small_ifs(stores));
  Sketch s;
  auto out = s.branch(
      s.less(s.read("s"), s.number(2)), {Type::kFloat},
      [&] { s.b.yield({s.b.call("noise", "float(point p)", {s.read("P")})}); },
      [&] { s.b.yield({s.number(0)}); });
  s.store("Ci", s.b.call("convert", "color(float x)", {out[0]}));
  Module m = s.finish();
  EXPECT_FALSE(select_small_ifs(m));
}

TEST(FuseProducts, AProductThatOnlyASumUsesIsComputedWithIt) {
  Sketch s;
  ValueId a = s.read("s"), b = s.read("t"), product = s.multiply(a, b);
  s.store("Ci", s.b.call("convert", "color(float x)", {s.add(s.read("u"), product)}));
  Module m = s.finish();
  EXPECT_TRUE(fuse_products(m));
  EXPECT_EQ(body(m), "  %0: float = slot s\n  %1: float = slot t\n  %2: float = slot u\n"
                     "  %3: float = call muladd %0, %1, %2\n  %4: color = call convert %3\n"
                     "  store Ci %4\n  yield\n");
}

TEST(FuseProducts, AFloatBeforeATripleChangesPlaces) {
  Sketch s;
  ValueId product = s.b.call("operator*", "color(float a, color b)", {s.read("s"), s.read("Cs")});
  s.store("Ci", s.b.call("operator+", "color(color a, color b)", {product, s.read("Os")}));
  Module m = s.finish();
  EXPECT_TRUE(fuse_products(m));
  EXPECT_EQ(body(m), "  %0: float = slot s\n  %1: color = slot Cs\n  %2: color = slot Os\n"
                     "  %3: color = call muladd %1, %0, %2\n  store Ci %3\n  yield\n");
}

TEST(FuseProducts, NotWhereOthersNeedTheProductOrItComesFromOutside) {
  Sketch s;
  ValueId twice = s.multiply(s.read("s"), s.read("t")), outside = s.multiply(s.read("u"), s.read("v"));
  auto x = s.branch(
      s.less(s.read("s"), s.number(1)), {Type::kFloat}, [&] { s.b.yield({s.add(outside, s.number(2))}); },
      [&] { s.b.yield({s.number(3)}); });
  s.store("Ci", s.b.call("convert", "color(float x)", {s.add(s.add(twice, x[0]), twice)}));
  Module m = s.finish();
  EXPECT_FALSE(fuse_products(m));
}

TEST(DerivativesFirst, BehindWhatTheyAreOfAndInFrontOfTheRest) {
  Sketch s;
  ValueId rest = s.multiply(s.read("t"), s.read("t"));
  ValueId slope = s.b.call("Du", "float(float x)", {s.multiply(s.read("s"), s.read("s"))});
  s.store("Ci", s.b.call("convert", "color(float x)", {s.add(rest, slope)}));
  Module m = s.finish();
  EXPECT_TRUE(derivatives_first(m));
  EXPECT_EQ(body(m), "  %0: float = slot s\n  %1: float = slot s\n  %2: float = call operator* %1, %0\n"
                     "  %3: float = call Du %2\n  %4: float = slot t\n  %5: float = slot t\n"
                     "  %6: float = call operator* %5, %4\n  %7: float = call operator+ %6, %3\n"
                     "  %8: color = call convert %7\n  store Ci %8\n  yield\n");
  EXPECT_FALSE(derivatives_first(m));
}

TEST(DerivativesFirst, StoresGoWithWhatReadsThem) {
  Sketch s;
  ValueId rest = s.multiply(s.read("t"), s.read("t"));
  s.store("P", s.read("E"));
  ValueId n = s.b.call("calculatenormal", "normal(point p)", {s.read("P")});
  s.store("N", n);
  s.store("Ci", s.b.call("convert", "color(float x)", {rest}));
  Module m = s.finish();
  EXPECT_TRUE(derivatives_first(m));
  EXPECT_EQ(body(m), "  %0: point = slot E\n  store P %0\n  %1: point = slot P\n"
                     "  %2: normal = call calculatenormal %1\n  %3: float = slot t\n  %4: float = slot t\n"
                     "  %5: float = call operator* %4, %3\n  store N %2\n  %6: color = call convert %5\n"
                     "  store Ci %6\n  yield\n");
}

TEST(DerivativesFirst, RegionsWithDerivativesAsAWhole) {
  Sketch s;
  ValueId rest = s.multiply(s.read("t"), s.read("t"));
  ValueId inside = s.multiply(s.read("s"), s.read("s"));
  auto x = s.branch(
      s.less(s.read("u"), s.read("v")), {Type::kFloat},
      [&] { s.b.yield({s.b.call("Du", "float(float x)", {inside})}); }, [&] { s.b.yield({s.read("u")}); });
  s.store("Ci", s.b.call("convert", "color(float x)", {s.add(rest, x[0])}));
  Module m = s.finish();
  EXPECT_TRUE(derivatives_first(m));
  const std::string text = body(m);
  EXPECT_LT(text.find("slot s"), text.find(" if ")) << text;
  EXPECT_LT(text.find(" if "), text.find("slot t")) << text;
}

TEST(Canonicalise, WhatPrintsOnceIsSettledBeforeAnyOtherPass) {
  Sketch s;
  for (ValueId x : {s.number(1), s.read("s")}) {
    const ValueId args[] = {s.b.string("%f"), x};
    s.b.call(shadeop_overloads("printf")[1], args, {});
  }
  Module m = s.finish();
  canonicalise(m);
  std::string text = body(m);
  EXPECT_NE(text.find("call printonce"), text.npos) << text;
  EXPECT_NE(text.find("call printf"), text.npos) << text;
  EXPECT_LT(text.find("call printonce"), text.find("call printf"));
}

TEST(InferDetail, DivergenceMakesCarriedValuesVarying) {
  Module m = while_loop();
  infer_detail(m);
  EXPECT_NE(print(m).find("varying float = loop"), std::string::npos);

  Sketch s; // a uniform loop that lanes leave at different rounds: what it counts differs
  auto out = s.loop({s.number(0)}, [&](const std::vector<ValueId>& carried) {
    s.branch(
        s.less(carried[0], s.read("s")), {}, [&] { s.b.yield({}); }, [&] { s.b.break_out(0, carried); });
    s.b.next_round(0, {s.add(carried[0], s.number(1))});
  });
  s.store("Ci", s.b.call("convert", "color(float x)", {out[0]}));
  Module divergent = s.finish();
  infer_detail(divergent);
  EXPECT_TRUE(divergent.varying(out[0]));
}

TEST(InferDetail, RaysMakeVaryingWhatTheirLoopsCarry) {
  Sketch s;
  std::vector<ValueId> args{s.b.string(""),
                            s.b.triple(Type::kPoint, 0, 0, 0),
                            s.b.triple(Type::kVector, 0, 0, 1),
                            s.number(0),
                            s.number(4),
                            s.number(0)};
  std::vector<Region> body;
  body.push_back(s.region({Type::kFloat}, [&](const std::vector<ValueId>& carried) {
    s.b.next_round(0, {s.add(carried[0], s.number(1))});
  }));
  const Type type = Type::kFloat;
  InstId id = s.b.region_inst(Op::kGather, shadeop_overloads("gather")[0], args, std::move(body),
                              std::span(&type, 1));
  const ValueId sum = s.m.insts[id].results[0];
  s.store("Ci", s.b.call("convert", "color(float x)", {sum}));
  Module m = s.finish();
  infer_detail(m);
  EXPECT_TRUE(m.varying(sum));
}

TEST(RemoveDead, LoopsOverRaysThatNobodyNeedsShootNone) {
  Module m = gather_loop();
  for (Inst& inst : m.insts)
    if (inst.op == Op::kStore) inst.args[0] = m.insts[m.body.body[0]].results[0];
  auto loops = [&] {
    size_t count = 0;
    for_each_inst(m, m.body, [&](InstId id) { count += m.insts[id].op == Op::kGather; });
    return count;
  };
  EXPECT_EQ(loops(), 1u);
  while (remove_dead(m)) {
  }
  EXPECT_EQ(loops(), 0u);
}

TEST(InferDetail, UniformLoopsStayUniform) {
  Module m = array_sum();
  infer_detail(m);
  std::string text = print(m);
  EXPECT_NE(text.find("%14: float, %15: varying float = loop"), std::string::npos) << text;
  EXPECT_TRUE(m.arrays[0].varying);
}

TEST(Optimise, LevelsAndRepetition) {
  for (auto& [name, m] : samples()) {
    std::string before = print(m);
    Module none = m, all = m;
    optimise(none, 0, nullptr);
    EXPECT_EQ(none.insts.size(), m.insts.size()) << name;
    optimise(all, 2, nullptr);
    std::string once = print(all);
    optimise(all, 2, nullptr);
    EXPECT_EQ(print(all), once) << name << ": a second run still finds something";
  }
}

} // namespace
} // namespace slvm::ir

// Each thing the passes rely on, broken in turn: verify_module() names it.
#include "slvm/ir/verify_ir.h"

#include "slvm/ir/passes/passes.h"
#include "tests/unit/ir/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace slvm::ir {
namespace {

using testing::HasSubstr;

Inst& first(Module& m, Op op) {
  for (Inst& inst : m.insts)
    if (inst.op == op) return inst;
  throw std::logic_error("the sample has no such instruction");
}

TEST(VerifyModule, AcceptsSamplesBeforeAndAfterPasses) {
  for (auto& [name, m] : samples()) {
    EXPECT_EQ(verify_module(m), "") << name;
    optimise(m, 2, nullptr);
    EXPECT_EQ(verify_module(m), "") << name;
  }
}

struct Case {
  const char* what;
  Module (*make)();
  void (*damage)(Module&);
  const char* expected;
};

class Corruption : public testing::TestWithParam<Case> {};

TEST_P(Corruption, IsRefused) {
  Module m = GetParam().make();
  GetParam().damage(m);
  EXPECT_THAT(verify_module(m), HasSubstr(GetParam().expected));
}

const Case kCases[] = {
    // Tables.
    {"SlotWithoutType", arithmetic, [](Module& m) { m.slots[1].type = Type::kVoid; },
     "variable 'N' has no proper type"},
    {"SlotThatIsNoGlobal", arithmetic, [](Module& m) { m.slots[1].name = "Nn"; },
     "'Nn' is not a predefined variable"},
    {"GlobalOfAnotherType", arithmetic, [](Module& m) { m.slots[1].type = Type::kPoint; },
     "'N' is not a predefined variable"},
    {"ParamOfAnotherDetail", arithmetic, [](Module& m) { m.params[0].varying = true; },
     "parameter 'Kd' does not agree"},
    {"ParamSlotOutOfBounds", arithmetic, [](Module& m) { m.params[0].slot = 99; },
     "parameter 'Kd' has no variable"},
    {"ParamInitOutOfBounds", arithmetic, [](Module& m) { m.params[0].init = 0; },
     "parameter 'Kd' has no variable or no default"},
    {"DefaultOfAnotherType", arithmetic, [](Module& m) { m.params[0].default_value.numbers.clear(); },
     "the default of parameter 'Kd' does not fit its type"},
    {"NoDefault", arithmetic, [](Module& m) { m.params[0].default_known = false; },
     "the default of parameter 'Kd' does not fit its type"},
    {"SharedInit", computed_default, [](Module& m) { m.params.push_back(m.params[0]); },
     "parameter 'scale' shares its default"},
    {"EmptyArray", array_sum, [](Module& m) { m.arrays[0].elements = 0; }, "an array out of bounds"},
    {"ArrayInNoSlot", array_sum, [](Module& m) { m.arrays[0].slot = 77; }, "an array out of bounds"},
    {"HugeArrays", array_sum,
     [](Module& m) {
       m.arrays.resize(3, {Type::kMatrix, 1u << 19, -1, false});
     },
     "more memory than allowed"},
    {"ConstantWithoutNumbers", arithmetic, [](Module& m) { m.constants[0].numbers.clear(); },
     "a constant does not fit its type"},
    // Structure.
    {"NoTerminator", arithmetic, [](Module& m) { m.body.body.pop_back(); }, "does not end in a terminator"},
    {"CodeAfterTerminator", varying_branch,
     [](Module& m) { std::swap(first(m, Op::kIf).regions[1].body[0], first(m, Op::kIf).regions[1].body[1]); },
     "does not end in a terminator"},
    {"EmptyRegion", varying_branch, [](Module& m) { first(m, Op::kIf).regions[1].body.clear(); },
     "an empty region"},
    {"MissingBranch", varying_branch, [](Module& m) { first(m, Op::kIf).regions.pop_back(); },
     "wrong number of arguments"},
    {"InstructionTwice", arithmetic,
     [](Module& m) { m.body.body.insert(m.body.body.begin(), m.body.body[0]); }, "in no or several places"},
    {"RegionInItself", varying_branch,
     [](Module& m) { first(m, Op::kIf).regions[0].body[0] = m.body.body[3]; }, "in no or several places"},
    {"NoSuchInstruction", arithmetic, [](Module& m) { m.body.body[0] = 1000; }, "in no or several places"},
    {"PositionInNoFile", arithmetic, [](Module& m) { m.insts[0].where.file = 9; }, "a position in no file"},
    // Values.
    {"UseOfLaterValue", arithmetic,
     [](Module& m) { first(m, Op::kCall).args[0] = first(m, Op::kRetype).results[0]; }, "not visible here"},
    {"UseOutOfBranch", varying_branch, [](Module& m) { first(m, Op::kStore).args[0] = 9999; },
     "not visible here"},
    {"ValueOfInnerRegion", while_loop,
     [](Module& m) { m.insts[m.body.body[2]].args[0] = first(m, Op::kLoop).regions[0].params[0]; },
     "not visible here"},
    {"DefinedTwice", arithmetic, [](Module& m) { m.insts[1].results[0] = m.insts[0].results[0]; },
     "defined nowhere or twice"},
    {"ValueOfBodyInDefault", computed_default,
     [](Module& m) {
       m.insts[m.inits[0].body.back()].args[0] = first(m, Op::kSlot).results[0];
       m.inits[0].body.erase(m.inits[0].body.begin(), m.inits[0].body.end() - 1);
     },
     "not visible here"},
    // Types.
    {"StoreOfAnotherType", arithmetic,
     [](Module& m) { first(m, Op::kStore).args[0] = m.insts[0].results[0]; }, "a value of the wrong type"},
    {"RetypeOfAFloat", arithmetic, [](Module& m) { first(m, Op::kRetype).args[0] = m.insts[0].results[0]; },
     "a value of the wrong type"},
    {"StoreToReadOnly", arithmetic, [](Module& m) { m.slots[first(m, Op::kStore).index].stored = false; },
     "a store to a read-only variable"},
    {"FloatCondition", varying_branch,
     [](Module& m) { first(m, Op::kIf).args[0] = first(m, Op::kSlot).results[0]; },
     "a condition that is not a bool"},
    {"ConstantOutOfBounds", arithmetic, [](Module& m) { first(m, Op::kConstant).index = 99; },
     "a constant out of bounds"},
    {"SlotOutOfBounds", arithmetic, [](Module& m) { first(m, Op::kSlot).index = 99; },
     "a variable out of bounds"},
    {"ArrayOutOfBounds", array_sum, [](Module& m) { first(m, Op::kArrayLoad).index = 9; },
     "an array out of bounds"},
    {"ArrayAsValue", array_sum, [](Module& m) { m.values[first(m, Op::kArrayLoad).results[0]].array = 0; },
     "an array where a value must be"},
    {"ArrayUnderAnothersName", array_sum,
     [](Module& m) {
       m.arrays.push_back({Type::kFloat, 2, -1, false});
       first(m, Op::kArray).index = 1;
     },
     "an array under another's name"},
    {"WritesReadOnlyArray", array_sum,
     [](Module& m) {
       m.slots.push_back({"knots", Type::kFloat, 4, true, false, false});
       m.arrays[0].slot = static_cast<int32_t>(m.slots.size()) - 1;
     },
     "a store to a read-only array"},
    // Calls.
    {"CallOfNothing", arithmetic, [](Module& m) { first(m, Op::kCall).index = 60000; },
     "a call of no shadeop"},
    {"TooFewArguments", arithmetic, [](Module& m) { first(m, Op::kCall).args.pop_back(); },
     "operands do not fit 'operator+'"},
    {"TooManyArguments", arithmetic,
     [](Module& m) { first(m, Op::kCall).args.push_back(first(m, Op::kCall).args[0]); },
     "operands do not fit 'operator+'"},
    {"CallOfRslBody", arithmetic,
     [](Module& m) { first(m, Op::kCall).index = shadeop_overloads("Deriv")[0]; }, "has no code of its own"},
    {"ArgumentOfAnotherType", messages,
     [](Module& m) { first(m, Op::kCall).args[0] = first(m, Op::kCall).args[1]; },
     "operands do not fit 'printf'"},
    {"ValueForArray", array_sum,
     [](Module& m) {
       for (Inst& i : m.insts)
         if (i.op == Op::kCall && i.args.size() == 1) {
           i.args[0] = first(m, Op::kSlot).results[0];
           break;
         }
     },
     "operands do not fit 'arraylength'"},
    {"MissingOutput", messages,
     [](Module& m) {
       for (Inst& i : m.insts)
         if (i.results.size() == 2) i.results.pop_back();
     },
     "operands do not fit 'displacement'"},
    // Regions.
    {"LoopCarriesMore", while_loop, [](Module& m) { first(m, Op::kLoop).args.clear(); },
     "wrong number of arguments"},
    {"ContinueCarriesLess", while_loop, [](Module& m) { first(m, Op::kContinue).args.clear(); },
     "wrong number of arguments"},
    {"BreakOutOfTooMuch", while_loop, [](Module& m) { first(m, Op::kBreak).index = 1; },
     "an exit from more loops than there are"},
    {"YieldInLoop", while_loop,
     [](Module& m) {
       Inst& c = first(m, Op::kContinue);
       c.op = Op::kYield;
     },
     "a yield in a loop"},
    {"NextRoundOfBlock", nested_exits,
     [](Module& m) { m.insts[first(m, Op::kBlock).regions[0].body.back()].op = Op::kContinue; },
     "the next round of no loop"},
    {"BodyYieldsValues", arithmetic,
     [](Module& m) { m.insts[m.body.body.back()].args = {m.insts[0].results[0]}; },
     "the shader's body yields values"},
    {"DefaultOfNoElement", computed_default, [](Module& m) { m.insts[m.inits[0].body.back()].args.clear(); },
     "another number of elements"},
    {"LightLoopInLight", illuminance_loop, [](Module& m) { m.kind = ShaderKind::kLight; },
     "a light statement in the wrong kind of shader"},
    {"ConeInSurface", cone_light, [](Module& m) { m.kind = ShaderKind::kSurface; },
     "a light statement in the wrong kind of shader"},
    {"ConeWithoutPs", cone_light, [](Module& m) { m.slots[1].name = "P"; },
     "a light cone without L, Ps and Ns"},
    {"CategoryOfAnotherType", illuminance_loop,
     [](Module& m) { first(m, Op::kIlluminance).args[0] = first(m, Op::kIlluminance).args[3]; },
     "a value of the wrong type"},
    {"RaysOfAnotherFunction", gather_loop,
     [](Module& m) { first(m, Op::kGather).index = shadeop_overloads("trace")[0]; },
     "a loop over the rays of no call"},
    {"RaysWithoutDirection", gather_loop,
     [](Module& m) {
       auto& args = first(m, Op::kGather).args;
       args.erase(args.begin() + 2);
     },
     "operands do not fit 'gather'"},
    {"RaysCarryAnotherType", gather_loop,
     [](Module& m) {
       auto& args = first(m, Op::kGather).args;
       args.back() = args[0];
     },
     "a value of the wrong type"},
};

INSTANTIATE_TEST_SUITE_P(VerifyModule, Corruption, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.what); });

TEST(VerifyModule, LightStatementsDoNotNest) {
  Sketch s;
  auto loop = [&](auto&& self, int depth) -> void {
    std::vector<ValueId> args{s.b.string(""), s.read("P"), s.b.retype(Type::kVector, s.read("N")),
                              s.number(1)};
    std::vector<Region> body;
    body.push_back(s.region({}, [&](auto&) {
      if (depth > 0) self(self, depth - 1);
      s.b.next_round(0, {});
    }));
    s.b.region_inst(Op::kIlluminance, 0, std::move(args), std::move(body), {});
  };
  loop(loop, 1);
  EXPECT_THAT(verify_module(s.finish()), HasSubstr("light statements do not nest"));
}

} // namespace
} // namespace slvm::ir

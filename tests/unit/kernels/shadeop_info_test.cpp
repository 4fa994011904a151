// The tables of shadeops, tokens and predefined variables as data.
#include "slvm/format/shadeop_info.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace slvm {
namespace {

TEST(ShadeopInfo, EveryRowIsFoundByNameAndSignature) {
  for (size_t i = 0; i < shadeops().size(); ++i) {
    const ShadeopInfo& row = shadeops()[i];
    EXPECT_TRUE(row.signature.ok) << row.name;
    EXPECT_FALSE(row.doc.empty()) << row.name << " " << row.signature_text;
    EXPECT_EQ(find_shadeop(row.name, row.signature_text), static_cast<int>(i))
        << row.name << " " << row.signature_text << " stands twice";
  }
}

TEST(ShadeopInfo, OverloadsKeepTableOrder) {
  auto rows = shadeop_overloads("noise");
  EXPECT_EQ(rows.size(), 20u); // 5 types, 4 domains
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  for (ShadeopId row : rows)
    EXPECT_EQ(shadeop(row).name, "noise");
  EXPECT_TRUE(shadeop_overloads("nois").empty());
  EXPECT_TRUE(shadeop_overloads("noise2").empty());
  EXPECT_EQ(find_shadeop("noise", "float(string s)"), -1);
}

TEST(ShadeopInfo, SignaturesAreReadInFull) {
  const Signature& s =
      shadeop(static_cast<ShadeopId>(find_shadeop(
                  "fresnel", "void(vector I, vector N, float eta, output float Kr, output float Kt)")))
          .signature;
  ASSERT_EQ(s.param_count, 5);
  EXPECT_EQ(s.result, Type::kVoid);
  EXPECT_TRUE(s.params[3].output);
  EXPECT_FALSE(s.params[3].input);
  EXPECT_EQ(s.params[4].name, "Kt");
}

TEST(ShadeopInfo, FoldedRowsAreBinaryAndOfOneType) {
  for (const ShadeopInfo& row : shadeops()) {
    if (!(row.flags & kFoldLeft)) continue;
    EXPECT_EQ(row.signature.param_count, 2) << row.name;
    EXPECT_EQ(row.signature.result, row.signature.params[0].type) << row.name;
  }
}

TEST(ShadeopInfo, TokenSetsOfSignaturesExist) {
  std::set<std::string> sets;
  for (const TokenInfo& t : tokens())
    sets.insert(std::string(t.set));
  for (const ShadeopInfo& row : shadeops()) {
    std::string set(row.signature.token_set);
    EXPECT_TRUE(set.empty() || sets.contains(set)) << row.name;
  }
}

TEST(ShadeopInfo, NoTokenStandsTwice) {
  std::set<std::string> seen;
  for (const TokenInfo& t : tokens())
    EXPECT_TRUE(seen.insert(std::string(t.set) + " " + std::string(t.name)).second) << t.set << " " << t.name;
}

TEST(ShadeopInfo, TokensAreFoundByNameOrPrefix) {
  EXPECT_EQ(find_token("texture", "blur")->type, Type::kFloat);
  EXPECT_EQ(find_token("texture", "blurr"), nullptr);
  EXPECT_EQ(find_token("nonsense", "blur"), nullptr);
  const TokenInfo* output = find_token("gather", "surface:Ci");
  ASSERT_NE(output, nullptr);
  EXPECT_TRUE(output->any);
  EXPECT_TRUE(output->output);
  EXPECT_EQ(find_token("gather", "ray:length")->type, Type::kFloat);
  EXPECT_EQ(find_token("gather", "surface"), nullptr);
  EXPECT_TRUE(find_token("bake3d", "my channel")->any);
}

TEST(ShadeopInfo, PredefinedVariablesAreFoundByName) {
  EXPECT_EQ(find_global("Ci"), Global::kCi);
  EXPECT_EQ(find_global("ci"), Global::kCount);
  for (int i = 0; i < kGlobalCount; ++i) {
    auto global = static_cast<Global>(i);
    EXPECT_EQ(find_global(global_info(global).name), global);
  }
}

} // namespace
} // namespace slvm

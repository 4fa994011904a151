// The RSL bodies of built-ins: all there, and all correct.
#include "slc/sema/builtins.h"

#include <gtest/gtest.h>

namespace {

TEST(Builtins, every_row_with_an_rsl_body_has_one) {
  slvm::SourceManager sources;
  slvm::Diagnostics diags;
  auto library = slc::BuiltinLibrary::load(slc::builtin_sources(), sources, diags);
  EXPECT_EQ(slvm::format_diagnostics(diags, sources), "");
  for (size_t id = 0; id < slvm::shadeops().size(); ++id) {
    const slvm::ShadeopInfo& info = slvm::shadeops()[id];
    if (info.kind != slvm::ShadeopKind::kRsl) continue;
    EXPECT_TRUE(library->body(static_cast<slc::ShadeopId>(id))) << info.name << " " << info.signature_text;
  }
}

TEST(Builtins, errors_in_bodies_have_places) {
  slvm::SourceManager sources;
  slvm::Diagnostics diags;
  slc::EmbeddedText file{"builtins/wrong.sl",
                         "color phong(normal N; vector V; float size) {\n  return nonsense;\n}\n"};
  slc::BuiltinLibrary::load({&file, 1}, sources, diags);
  EXPECT_EQ(slvm::format_diagnostics(diags, sources),
            "builtins/wrong.sl:2:10: error: unknown variable 'nonsense'\n"
            "    2 |   return nonsense;\n      |          ^~~~~~~~\n");
}

} // namespace

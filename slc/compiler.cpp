// The steps of a compilation, one after another.
#include "slc/compiler.h"

#include "slc/diag/messages.h"
#include "slc/embedded.h"
#include "slc/lex/lexer.h"
#include "slc/parse/parse.h"
#include "slc/sema/sema.h"

#include <algorithm>

namespace slc {

Compiler::Compiler() {
  slvm::SourceManager sources;
  slvm::Diagnostics diags;
  builtins_ = BuiltinLibrary::load(builtin_sources(), sources, diags);
  if (diags.has_errors()) builtins_error_ = slvm::format_diagnostics(diags, sources);
}

PreprocessedText Compiler::preprocess(slvm::FileId main, const CompileOptions& options,
                                      slvm::SourceManager& sources, slvm::Diagnostics& diags) const {
  PreprocessOptions complete = options.preprocess;
  complete.defines.push_back("ANEMONE=1");
  complete.standard_headers = standard_headers();
  return slc::preprocess(main, complete, sources, diags);
}

namespace {

// What is said about text out of a macro stands at the use of the macro: name the macro, too.
void explain_expansions(const PreprocessedText& text, slvm::Diagnostics& diags) {
  diags.for_each([&](slvm::Diagnostic& d) {
    auto it = std::find_if(text.expansions.begin(), text.expansions.end(),
                           [&](const Expansion& e) { return e.use == d.where; });
    if (it == text.expansions.end()) return;
    d.fixits.clear(); // they are for text that does not stand here
    d.notes.push_back(
        {it->definition, "in the expansion of macro '" + it->macro + "', which is defined here"});
  });
}

} // namespace

CheckedSource Compiler::check(slvm::FileId main, const CompileOptions& options, slvm::SourceManager& sources,
                              slvm::Diagnostics& diags) const {
  CheckedSource checked;
  if (!builtins_error_.empty()) diags.error({}, "in the built-in functions: " + builtins_error_);
  checked.text = preprocess(main, options, sources, diags);
  if (diags.has_true_errors()) return checked; // text is missing: what would follow from that is no news
  checked.unit = parse(lex(checked.text, diags), diags);
  analyse(checked.unit, builtins_, diags, options.plugins);
  explain_expansions(checked.text, diags);
  if (checked.unit.shaders.empty() && !diags.has_true_errors())
    report(diags, Msg::kNoShader, slvm::SourceRange{main, 0, 0, 0});
  return checked;
}

} // namespace slc

// The steps of a compilation, one after another.
#include "slc/compiler.h"

#include "slc/embedded.h"
#include "slc/lex/lexer.h"
#include "slc/parse/parse.h"
#include "slc/sema/sema.h"

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

CheckedSource Compiler::check(slvm::FileId main, const CompileOptions& options, slvm::SourceManager& sources,
                              slvm::Diagnostics& diags) const {
  CheckedSource checked;
  if (!builtins_error_.empty()) diags.error({}, "in the built-in functions: " + builtins_error_);
  checked.text = preprocess(main, options, sources, diags);
  if (diags.has_errors()) return checked; // text is missing: what would follow from that is no news
  checked.unit = parse(lex(checked.text, diags), diags);
  analyse(checked.unit, builtins_, diags);
  return checked;
}

} // namespace slc

// RSL bodies of built-ins: the functions of stdlib/builtins, each the body of the row of shadeops.def with
// its name and signature. Checked once, then only read: one library serves any number of compilations and
// threads.
#pragma once

#include "slc/ast/unit.h"
#include "slc/embedded.h"
#include "slc/lex/lexer.h"
#include "slvm/support/diagnostics.h"

namespace slc {

class BuiltinLibrary {
public:
  /// Parses and checks the files. Functions that match no row are helpers. Errors carry positions in
  /// `sources`, into which the files are added; the finished nodes carry none.
  static std::shared_ptr<const BuiltinLibrary> load(std::span<const EmbeddedText> files,
                                                    slvm::SourceManager& sources, slvm::Diagnostics& diags);

  /// The body of a row, or null.
  const FunctionDef* body(ShadeopId row) const { return row < bodies_.size() ? bodies_[row] : nullptr; }
  /// The nodes; the pointer keeps the library alive.
  static std::shared_ptr<const TranslationUnit> unit(std::shared_ptr<const BuiltinLibrary> library) {
    const TranslationUnit* unit = &library->unit_;
    return {std::move(library), unit};
  }
  const TranslationUnit& nodes() const { return unit_; }

private:
  void build(TokenList tokens, slvm::Diagnostics& diags);

  TranslationUnit unit_;
  std::vector<const FunctionDef*> bodies_; // by ShadeopId
};

} // namespace slc

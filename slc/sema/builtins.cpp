// Loading the RSL bodies of built-ins, and the entry to semantic analysis.
#include "slc/sema/builtins.h"

#include "slc/parse/parse.h"
#include "slc/sema/checker.h"
#include "slc/sema/contexts.h"
#include "slc/sema/sema.h"

#include <iterator>

namespace slc {
namespace {

// Whether a function has exactly the row's name and signature; surplus formals with a constant default take
// the row's token-value pairs.
bool is_body_of(const FunctionDef& f, const slvm::ShadeopInfo& row) {
  const slvm::Signature& s = row.signature;
  auto count = static_cast<size_t>(s.param_count);
  if (row.kind != slvm::ShadeopKind::kRsl || row.name != f.name || s.result != f.result ||
      f.formals.size() < count)
    return false;
  for (size_t i = 0; i < f.formals.size(); ++i) {
    const Variable& v = *f.formals[i];
    if (i >= count) {
      bool constant = v.init && (v.init->kind == ExprKind::kNumber || v.init->kind == ExprKind::kString);
      const slvm::TokenInfo* token = slvm::find_token(s.token_set, v.name);
      if (!constant || !token || token->type != v.type) return false;
      continue;
    }
    const slvm::SignatureParam& p = s.params[i];
    if (p.type != v.type || p.output != v.output || p.array != (v.array_length != kNotArray)) return false;
  }
  return true;
}

} // namespace

void BuiltinLibrary::build(TokenList tokens, slvm::Diagnostics& diags) {
  unit_ = parse(std::move(tokens), diags);
  bodies_.assign(slvm::shadeops().size(), nullptr);
  for (FunctionDef& f : unit_.functions)
    for (ShadeopId id : slvm::shadeop_overloads(f.name))
      if (is_body_of(f, slvm::shadeop(id))) {
        f.shadeop = id;
        bodies_[id] = &f;
      }
  Checker(unit_, *this, true, diags).check_unit();
}

std::shared_ptr<const BuiltinLibrary> BuiltinLibrary::load(std::span<const EmbeddedText> files,
                                                           slvm::SourceManager& sources,
                                                           slvm::Diagnostics& diags) {
  TokenList all;
  for (const EmbeddedText& file : files) {
    PreprocessOptions options;
    options.read = [](const std::string&) { return std::nullopt; };
    slvm::FileId id = sources.add(std::string(file.name), std::string(file.text));
    TokenList tokens = lex(preprocess(id, options, sources, diags), diags);
    if (!all.tokens.empty()) all.tokens.pop_back(); // the end mark
    all.tokens.insert(all.tokens.end(), std::make_move_iterator(tokens.tokens.begin()),
                      std::make_move_iterator(tokens.tokens.end()));
  }
  if (all.tokens.empty()) all.tokens.emplace_back();
  auto library = std::make_shared<BuiltinLibrary>();
  TokenList nowhere = all;
  for (Token& token : nowhere.tokens)
    token.range = {};
  slvm::Diagnostics unplaced;
  library->build(std::move(nowhere), unplaced);
  if (unplaced.has_errors()) { // once more, to say where
    library = std::make_shared<BuiltinLibrary>();
    library->build(std::move(all), diags);
  }
  return library;
}

void analyse(TranslationUnit& unit, std::shared_ptr<const BuiltinLibrary> library, slvm::Diagnostics& diags,
             const slvm::PluginSource* plugins) {
  Checker(unit, *library, false, diags, plugins).check_unit();
  check_contexts(unit, diags);
  unit.builtins = BuiltinLibrary::unit(std::move(library));
}

} // namespace slc

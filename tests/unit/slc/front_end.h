// What the tests of this folder share: running parts of the front end on text in memory.
#pragma once

#include "slc/ast/print.h"
#include "slc/compiler.h"
#include "slc/lex/lexer.h"
#include "slc/parse/parse.h"

#include <map>
#include <string>

namespace slc_test {

/// One compilation of "main.sl", with included files by name.
struct Front {
  slvm::SourceManager sources;
  slvm::Diagnostics diags;
  slc::CompileOptions options;
  std::map<std::string, std::string> files;

  Front() {
    options.preprocess.read = [this](const std::string& path) -> std::optional<std::string> {
      auto it = files.find(path);
      if (it == files.end()) return std::nullopt;
      return it->second;
    };
  }
  slc::PreprocessedText preprocess(const std::string& text) {
    return slc::preprocess(sources.add("main.sl", text), options.preprocess, sources, diags);
  }
  slc::TokenList lex(const std::string& text) { return slc::lex(preprocess(text), diags); }
  slc::TranslationUnit parse(const std::string& text) { return slc::parse(lex(text), diags); }
  slc::CheckedSource check(const std::string& text) {
    static const slc::Compiler kCompiler;
    return kCompiler.check(sources.add("main.sl", text), options, sources, diags);
  }
  std::string messages() const { return slvm::format_diagnostics(diags, sources); }
};

} // namespace slc_test

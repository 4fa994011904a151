#include "slc/tools/inspected.h"

#include "slc/embedded.h"
#include "slc/preprocess/preprocess.h"
#include "slvm/ir/serialise.h"

#include <algorithm>

namespace slc {
namespace {

// The text of a file of the source, from disk or among the headers that the compiler brings along.
std::optional<std::string> text_of(const slvm::Program& program, const std::string& path,
                                   const std::string& name) {
  for (const EmbeddedText& header : standard_headers())
    if (name == std::string(kStandardFolder) + std::string(header.name)) return std::string(header.text);
  const std::string found = slvm::find_source(program, path, name);
  return found.empty() ? std::nullopt : read_file(found);
}

} // namespace

SourceLines::SourceLines(const slvm::Program& program, const std::string& path) {
  ids_.resize(program.files.size());
  std::vector<bool> named(program.files.size());
  for (const slvm::LineEntry& l : program.lines)
    if (l.file < named.size()) named[l.file] = true;
  for (size_t i = 0; i < named.size(); ++i)
    if (named[i])
      if (auto text = text_of(program, path, program.files[i]))
        ids_[i] = sources_.add(program.files[i], std::move(*text));
}

std::string SourceLines::text(uint32_t file, uint32_t line) const {
  if (file >= ids_.size() || !ids_[file]) return "";
  std::string_view text = sources_.line(ids_[file], line);
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  return std::string(text);
}

slvm::Result<Inspected> inspect(slvm::Program program, std::string path, bool with_uses) {
  if (!with_uses || program.ir.empty()) return Inspected{std::move(program), std::move(path), {}};
  auto module = slvm::ir::deserialise(program.ir);
  if (!module) return slvm::Error{"damaged: " + module.error()};
  std::vector<slvm::SourceCall> calls = program.facts.calls;
  for (slvm::SourceCall& c : calls) // functions of plug-ins have other ids there
    if (program.plugins.find(c.shadeop))
      if (auto id = module->plugins.add(program.plugins.list()[c.shadeop - slvm::kFirstPluginShadeop]))
        c.shadeop = *id;
  Uses uses = collect_uses(*module, calls);
  return Inspected{std::move(program), std::move(path), std::move(uses)};
}

} // namespace slc

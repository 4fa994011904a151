// Reading the tables of plug-ins. Their layout is that of the headers in sdk; strings in them are bounded.
#include "slvm/plugin/library.h"

#include "slvm/plugin/prototype.h"
#include "slvm/plugin/sdk/RslPlugin.h"

#include <cstring>
#include <filesystem>
#include <fmt/format.h>

namespace slvm {

/// An entry of a table NAME_shadeops: SHADEOP_SPEC of sdk/shadeop.h, which is no C++.
struct PointwiseRow {
  const char *definition, *init, *shutdown;
};

namespace {

constexpr size_t kMostRows = 4096;

std::string bounded(const char* text) {
  return text ? std::string(text, ::strnlen(text, kMaxPrototype + 1)) : std::string();
}

} // namespace

Result<std::shared_ptr<const PluginLibrary>> PluginLibrary::open(const std::string& path) {
  auto file = SharedLibrary::open(path);
  if (!file) return Error{file.error()};
  std::shared_ptr<PluginLibrary> library(new PluginLibrary(*file));
  if (std::string error = library->read_grid_table(); !error.empty())
    return Error{fmt::format("{}: {}", path, error)};
  return std::shared_ptr<const PluginLibrary>(library);
}

std::string PluginLibrary::name() const {
  return std::filesystem::path(path()).filename().string();
}

// The error is one of the whole library.
std::string PluginLibrary::read_grid_table() {
  const void* symbol = library_->symbol("RslPublicFunctions");
  if (!symbol) return "";
  const auto* version = static_cast<const int*>(library_->symbol("anemone_rslplugin_interface"));
  if (!version)
    return "its RslPublicFunctions was not compiled with Anemone's RslPlugin.h: compile its source with that "
           "header";
  if (*version != ANEMONE_RSLPLUGIN_INTERFACE)
    return fmt::format(
        "it was compiled with version {} of RslPlugin.h, this program wants version {}: compile it again",
        *version, ANEMONE_RSLPLUGIN_INTERFACE);
  const auto& table = *static_cast<const RslFunctionTable*>(symbol);
  library_init_ = reinterpret_cast<void*>(table.init);
  library_cleanup_ = reinterpret_cast<void*>(table.cleanup);
  for (size_t i = 0; table.functions && i < kMostRows && table.functions[i].prototype; ++i) {
    const RslFunction& row = table.functions[i];
    const std::string text = bounded(row.prototype);
    Result<Prototype> prototype = parse_prototype(text);
    if (!prototype || !row.entry) {
      grid_trouble_.push_back(fmt::format("{}: \"{}\" in RslPublicFunctions: {}", path(), text.substr(0, 200),
                                          prototype ? "it has no function" : prototype.error()));
      continue;
    }
    PluginEntry& e = grid_.emplace_back();
    e.function = prototype->name;
    e.signature = prototype->signature();
    e.form = prototype->array_result ? PluginForm::kGridArray : PluginForm::kGrid;
    e.entry = reinterpret_cast<void*>(row.entry);
    e.init = reinterpret_cast<void*>(row.init);
    e.shutdown = reinterpret_cast<void*>(row.cleanup);
    e.begin = reinterpret_cast<void*>(row.begin);
    e.end = reinterpret_cast<void*>(row.end);
    e.thread_safe = true;
    e.shared = i;
  }
  return "";
}

bool PluginLibrary::read_entry(const PointwiseRow& row, const std::string& function, PluginEntry& out,
                               std::string& trouble) const {
  const std::string text = bounded(row.definition);
  auto fail = [&](const std::string& what) {
    trouble = fmt::format("{}: \"{}\" in the table of '{}': {}", path(), text.substr(0, 200), function, what);
    return false;
  };
  Result<Prototype> prototype = parse_prototype(text);
  if (!prototype) return fail(prototype.error());
  if (prototype->array_result) return fail("it returns an array, which functions called by point cannot");
  out.function = function;
  out.signature = prototype->signature();
  out.form = PluginForm::kPointwise;
  const std::string init = bounded(row.init), shutdown = bounded(row.shutdown);
  const std::pair<std::string, void**> wanted[] = {
      {prototype->name, &out.entry}, {init, &out.init}, {shutdown, &out.shutdown}};
  for (auto& [name, address] : wanted) {
    if (name.empty()) continue;
    *address = library_->symbol(name);
    if (!*address)
      return fail(
          fmt::format("the library exports no '{}'; in C++ it needs extern \"C\", which the macros of "
                      "shadeop.h bring",
                      name.substr(0, 100)));
  }
  out.thread_safe = library_->symbol(function + "_threadsafe") != nullptr;
  out.shared = std::hash<std::string>()(init + '/' + shutdown);
  return true;
}

std::vector<PluginEntry> PluginLibrary::functions(const std::string& function,
                                                  std::vector<std::string>& trouble) const {
  std::vector<PluginEntry> found;
  if (const void* table = library_->symbol(function + "_shadeops")) {
    const auto* rows = static_cast<const PointwiseRow*>(table);
    // A table without its closing entry ends where the linker says.
    const size_t size = library_->size_of(table);
    const size_t most = size ? size / sizeof(PointwiseRow) : kMostRows;
    for (size_t i = 0; i < most && rows[i].definition && *rows[i].definition; ++i) {
      PluginEntry entry;
      std::string problem;
      if (read_entry(rows[i], function, entry, problem))
        found.push_back(std::move(entry));
      else
        trouble.push_back(std::move(problem));
    }
  }
  for (const PluginEntry& entry : grid_)
    if (entry.function == function) found.push_back(entry);
  for (const std::string& problem : grid_trouble_)
    if (problem.find(' ' + function + '(') != problem.npos ||
        problem.find(' ' + function + ' ') != problem.npos)
      trouble.push_back(problem);
  return found;
}

} // namespace slvm

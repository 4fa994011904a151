// One library of functions for shaders, opened: what its tables say. PUBLIC. Two forms (docs/plugins.md): a
// table NAME_shadeops for each function (sdk/shadeop.h, called by point), and one table RslPublicFunctions
// (sdk/RslPlugin.h, called by grid). Read next: finder.h (for the compiler), slvm/exec/plugin_host.h (running
// them).
#pragma once

#include "slvm/format/plugin_shadeop.h"
#include "slvm/support/shared_library.h"

#include <map>

namespace slvm {

/// A function as a table has it.
struct PluginEntry {
  std::string function;
  std::string signature; ///< as in PluginFunctionName
  PluginForm form = PluginForm::kPointwise;
  void* entry = nullptr;                     ///< SHADEOP, or RslEntryFunc
  void *init = nullptr, *shutdown = nullptr; ///< null: none
  void *begin = nullptr, *end = nullptr;     ///< of grid functions: before init and after shutdown
  bool thread_safe = false;                  ///< several threads may call it at once
  /// Functions of one table with the same init and shutdown share what init returns. Equal for those.
  size_t shared = 0;
};

struct PointwiseRow;

class PluginLibrary {
public:
  /// Opens a library and reads its table of grid functions, if it has one.
  static Result<std::shared_ptr<const PluginLibrary>> open(const std::string& path);

  const std::string& path() const { return library_->path(); }
  /// File name without folders.
  std::string name() const;
  /// Functions of this name, of both forms, in the order of their tables. `trouble`: entries that cannot be
  /// used, and why.
  std::vector<PluginEntry> functions(const std::string& function, std::vector<std::string>& trouble) const;
  /// All functions of the table of grid functions; those of the other form are known by name only.
  const std::vector<PluginEntry>& grid_functions() const { return grid_; }
  /// What was wrong with entries of that table.
  const std::vector<std::string>& grid_trouble() const { return grid_trouble_; }
  /// Null, or the library's functions to be called before its first and after its last function of this form.
  void* library_init() const { return library_init_; }
  void* library_cleanup() const { return library_cleanup_; }
  /// anemone_enter of sdk/rx.h, which tells the library of each call; null: it asks for no services.
  void* enter() const { return library_->symbol("anemone_enter"); }

private:
  explicit PluginLibrary(std::shared_ptr<const SharedLibrary> library) : library_(std::move(library)) {}
  std::string read_grid_table();
  bool read_entry(const PointwiseRow& row, const std::string& function, PluginEntry& out,
                  std::string& trouble) const;

  std::shared_ptr<const SharedLibrary> library_;
  std::vector<PluginEntry> grid_;
  std::vector<std::string> grid_trouble_;
  void *library_init_ = nullptr, *library_cleanup_ = nullptr;
};

} // namespace slvm

// Strict reading of TOML tables: every key must be asked for, or finish() reports it with the nearest key
// there is. Errors go to a Diagnostics with their place in the file.
#pragma once

#include "slvm/support/diagnostics.h"
#include "slvm/tools/sltest/value.h"

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace slvm::sltest {

/// The file being read, and where its errors go.
struct TomlSource {
  std::string name;
  FileId file = 0;
  Diagnostics& diags;

  SourceRange range(const toml::node& node) const;
  Where where(const toml::node& node) const;
  void error(const toml::node& node, std::string text) const { diags.error(range(node), std::move(text)); }
};

class TableReader {
public:
  TableReader(const toml::table& table, const TomlSource& source) : table_(table), source_(source) {}

  /// The node of this key, or null.
  const toml::node* get(std::string_view key);
  /// Reads a value if the key is there; an error if it has another type.
  bool read(std::string_view key, std::string& value);
  bool read(std::string_view key, bool& value);
  bool read(std::string_view key, double& value);
  const toml::table* table(std::string_view key);
  const toml::array* array(std::string_view key);
  /// Reports keys that nobody asked for.
  void finish();

private:
  const toml::table& table_;
  const TomlSource& source_;
  std::vector<std::string_view> known_;
};

/// Entries of a table in the order of the file.
std::vector<std::pair<std::string, const toml::node*>> in_file_order(const toml::table& table);

/// A number, text, bool (1 or 0), or list of numbers, of texts or of equally long lists of numbers.
bool read_raw(const toml::node& node, const TomlSource& source, RawValue& raw);

} // namespace slvm::sltest

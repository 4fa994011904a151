// Modules of Anemone itself: shared libraries that wrap what takes long to load and is seldom needed. PUBLIC.
#pragma once

#include <string>

namespace slvm {

/// The function `entry` of the module `name` ("anemone_images"), from beside this program, from where it is
/// installed with this program, or from where Anemone is installed. Null: `problem` says why, `without` first
/// where there is no such file. Modules stay loaded: the libraries behind them have threads of their own.
void* find_in_module(const std::string& name, const char* entry, const std::string& without,
                     std::string& problem);

/// The functions of the module, which `entry` fills in; unset when the table's `problem` says why.
template <class Table>
Table load_module(const std::string& name, const char* entry, const std::string& without) {
  Table table;
  if (void* fill = find_in_module(name, entry, without, table.problem))
    reinterpret_cast<void (*)(Table*)>(fill)(&table);
  return table;
}

} // namespace slvm

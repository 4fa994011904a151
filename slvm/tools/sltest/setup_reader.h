// The part of a case, or of [defaults], that says what is to be run.
#pragma once

#include "slvm/tools/sltest/setup.h"
#include "slvm/tools/sltest/toml_reader.h"

namespace slvm::sltest {

/// Reads what the table gives over what `setup` has: single keys replace, tables of names are merged.
void read_setup(TableReader& table, const TomlSource& source, Setup& setup);

} // namespace slvm::sltest

// Sweeps: a case that runs for every combination of some values.
#pragma once

#include "slvm/tools/sltest/test_case.h"
#include "slvm/tools/sltest/toml_reader.h"

namespace slvm::sltest {

/// Reads the table `sweep` over what `sweeps` has; a name replaces the one of before.
void read_sweeps(const toml::table& table, const TomlSource& source, std::vector<Sweep>& sweeps);

/// The cases a case stands for: one for each combination, the last sweep fastest. Names say which: ", Kd =
/// 0.5".
std::vector<Case> expand_sweeps(const Case& c);

} // namespace slvm::sltest

// Tables of arguments and results, run under all circumstances in which the language can meet them.
//
// Each row is run with uniform arguments on a single point. All rows together are run with varying arguments,
// tiled over a grid of several strips: straight, under an `if` that leaves out every other point, and in a
// loop that every point leaves in another round. Tables with arguments that must be uniform are run row by
// row on such grids.
#pragma once

#include "slvm/tools/sltest/test_case.h"

#include <vector>

namespace slvm::sltest {

/// The cases a case with a table stands for.
std::vector<Case> expand_table(const Case& c);

} // namespace slvm::sltest

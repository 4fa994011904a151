// Diagnostics for programs: an object of JSON a line. docs/diagnostics-schema.md describes it.
#pragma once

#include "slvm/support/diagnostics.h"

namespace slc {

std::string diagnostics_json(const slvm::Diagnostics&, const slvm::SourceManager&);

} // namespace slc

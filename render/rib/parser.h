// From tokens to requests. Arguments are checked against requests.def; after an error the parser goes on at
// the next known request.
#pragma once

#include "render/rib/ri_target.h"
#include "slvm/support/diagnostics.h"

#include <string_view>

namespace render {

class TokenStream;

/// Parses a whole RIB text, ASCII and binary, and hands its requests to `target`, in order. Errors go to
/// `diagnostics` with positions in `file`. Any bytes are safe input; nothing recurses.
void parse_rib(std::string_view text, slvm::FileId file, RiTarget& target, slvm::Diagnostics& diagnostics);

/// The same for any source of tokens.
void parse_rib(TokenStream& tokens, RiTarget& target, slvm::Diagnostics& diagnostics);

} // namespace render

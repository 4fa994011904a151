// The encodings of the data in multipart RIB (RFC 2045).
#pragma once

#include "slvm/support/result.h"

#include <string>
#include <string_view>

namespace render {

/// `data` decoded from "quoted-printable" or "base64"; "", "7bit", "8bit" and "binary" leave it as it is. The
/// error names what is wrong.
slvm::Result<std::string> decode_content(std::string_view encoding, std::string_view data);

} // namespace render

// Search paths: "dir:dir" with & for the previous path, @ for the default one, and environment variables.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace render {

/// ":" separates, ";" too; `$VAR`, `${VAR}` and `%VAR%` are replaced from the environment. A ":" after a
/// single letter and before a slash belongs to a Windows drive.
std::vector<std::string> parse_search_path(std::string_view text, const std::vector<std::string>& previous,
                                           const std::vector<std::string>& standard);

/// The first of the directories that has the file. A name with folders that do not exist here, as files from
/// other machines have, is looked for without them.
std::optional<std::string> find_file(std::string_view name, const std::vector<std::string>& directories);

/// The whole file, or nothing when it cannot be read.
std::optional<std::string> read_file(const std::string& path);

} // namespace render

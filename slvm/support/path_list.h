// Search paths: lists of folders as users write them, and the files found in them. PUBLIC.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slvm {

/// The folders of "a:b;c". The colon of a drive ("c:/models") separates nothing; empty entries are left out.
std::vector<std::string> split_path_list(std::string_view text);

/// `name` in the first folder that has such a file ("" is the current one), normalised; absolute names stand
/// for themselves. "" when there is none.
std::string find_in_folders(const std::string& name, std::span<const std::string> folders);

/// The same for a shader: a name without .sl or .slo is, in each folder, that of a .slo, a .sl, or a file.
std::string find_shader_file(const std::string& name, std::span<const std::string> folders);

} // namespace slvm

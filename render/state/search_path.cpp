// Search paths and reading of files.
#include "render/state/search_path.h"

#include "slvm/support/path_list.h"

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace render {

namespace {

std::string environment(std::string_view name) {
  const char* value = std::getenv(std::string(name).c_str());
  return value ? value : "";
}

bool is_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

std::string expand_variables(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size();) {
    char c = text[i];
    size_t end = std::string_view::npos;
    if (c == '%' && (end = text.find('%', i + 1)) != std::string_view::npos) {
      out += environment(text.substr(i + 1, end - i - 1));
      i = end + 1;
    } else if (c == '$' && i + 1 < text.size() && text[i + 1] == '{' &&
               (end = text.find('}', i)) != std::string_view::npos) {
      out += environment(text.substr(i + 2, end - i - 2));
      i = end + 1;
    } else if (c == '$' && i + 1 < text.size() && is_name(text[i + 1])) {
      for (end = i + 1; end < text.size() && is_name(text[end]);)
        ++end;
      out += environment(text.substr(i + 1, end - i - 1));
      i = end;
    } else {
      out += c;
      ++i;
    }
  }
  return out;
}

} // namespace

std::vector<std::string> parse_search_path(std::string_view text, const std::vector<std::string>& previous,
                                           const std::vector<std::string>& standard) {
  std::vector<std::string> out;
  for (std::string& folder : slvm::split_path_list(expand_variables(text)))
    if (folder == "&")
      out.insert(out.end(), previous.begin(), previous.end());
    else if (folder == "@")
      out.insert(out.end(), standard.begin(), standard.end());
    else
      out.push_back(std::move(folder));
  return out;
}

std::optional<std::string> find_file(std::string_view name, const std::vector<std::string>& directories) {
  std::string found = slvm::find_in_folders(std::string(name), directories);
  // "C:\\models\\ball.rib" and "/usr/anna/ball.rib" of another machine: the file may have come along.
  std::string_view base = name.substr(name.find_last_of("/\\") + 1); // npos + 1 is 0
  if (found.empty() && base != name && !base.empty())
    found = slvm::find_in_folders(std::string(base), directories);
  return found.empty() ? std::nullopt : std::optional(std::move(found));
}

std::optional<std::string> read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return {};
  std::ostringstream text;
  text << in.rdbuf();
  if (!in.good() && !in.eof()) return {};
  return std::move(text).str();
}

} // namespace render

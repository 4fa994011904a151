// Search paths and reading of files.
#include "render/state/search_path.h"

#include <cctype>
#include <cstdlib>
#include <filesystem>
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
  std::string expanded = expand_variables(text);
  std::vector<std::string> out;
  std::string word;
  auto finish = [&] {
    if (word == "&")
      out.insert(out.end(), previous.begin(), previous.end());
    else if (word == "@")
      out.insert(out.end(), standard.begin(), standard.end());
    else if (!word.empty())
      out.push_back(word);
    word.clear();
  };
  for (size_t i = 0; i < expanded.size(); ++i) {
    char c = expanded[i];
    char next = i + 1 < expanded.size() ? expanded[i + 1] : '\0';
    bool drive = c == ':' && word.size() == 1 && std::isalpha(static_cast<unsigned char>(word[0])) &&
                 (next == '/' || next == '\\');
    if ((c == ':' && !drive) || c == ';')
      finish();
    else
      word += c;
  }
  finish();
  return out;
}

namespace {

std::optional<std::string> find_in(const std::filesystem::path& path,
                                   const std::vector<std::string>& directories) {
  namespace fs = std::filesystem;
  std::error_code error;
  for (const std::string& directory : directories) {
    fs::path candidate = fs::path(directory) / path;
    if (fs::is_regular_file(candidate, error)) return candidate.lexically_normal().string();
  }
  return {};
}

} // namespace

std::optional<std::string> find_file(std::string_view name, const std::vector<std::string>& directories) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::path path(name);
  if (path.is_absolute()) {
    if (fs::is_regular_file(path, error)) return path.string();
  } else if (auto found = find_in(path, directories)) {
    return found;
  }
  // "C:\\models\\ball.rib" and "/usr/anna/ball.rib" of another machine: the file may have come along.
  std::string_view base = name.substr(name.find_last_of("/\\") + 1); // npos + 1 is 0
  if (base == name || base.empty()) return {};
  return find_in(fs::path(base), directories);
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

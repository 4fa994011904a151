// Source text by file and line.
#include "slvm/support/source.h"

#include <utility>

namespace slvm {

SourceRange join(SourceRange first, SourceRange last) {
  if (!first.valid()) return last;
  if (last.file == first.file && last.line == first.line && last.end > first.end) first.end = last.end;
  return first;
}

SourceManager::SourceManager() {
  files_.emplace_back();
}

FileId SourceManager::add(std::string name, std::string text) {
  File file{std::move(name), std::move(text), {}, {}};
  file.line_starts.push_back(0);
  for (size_t i = 0; i < file.text.size(); ++i) {
    bool cr = file.text[i] == '\r', lf = file.text[i] == '\n';
    if (cr && i + 1 < file.text.size() && file.text[i + 1] == '\n') continue; // CRLF counts at its LF
    if (cr || lf) file.line_starts.push_back(static_cast<uint32_t>(i + 1));
  }
  files_.push_back(std::move(file));
  return static_cast<FileId>(files_.size() - 1);
}

FileId SourceManager::find(std::string_view name) const {
  for (size_t i = 1; i < files_.size(); ++i)
    if (files_[i].name == name) return static_cast<FileId>(i);
  return 0;
}

std::string_view SourceManager::name(FileId id) const {
  return id < files_.size() ? std::string_view(files_[id].name) : std::string_view();
}

std::string_view SourceManager::text(FileId id) const {
  return id < files_.size() ? std::string_view(files_[id].text) : std::string_view();
}

std::string_view SourceManager::line(FileId id, uint32_t line) const {
  if (id >= files_.size() || line == 0 || line > files_[id].line_starts.size()) return {};
  const File& file = files_[id];
  size_t begin = file.line_starts[line - 1];
  size_t end = line < file.line_starts.size() ? file.line_starts[line] : file.text.size();
  std::string_view text = std::string_view(file.text).substr(begin, end - begin);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

} // namespace slvm

#include "slvm/tools/sltest/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace slvm::sltest {

SourceRange TomlSource::range(const toml::node& node) const {
  const toml::source_region& r = node.source();
  const uint32_t end = r.end.line == r.begin.line ? r.end.column : r.begin.column + 1;
  return {file, r.begin.line, r.begin.column, end};
}

Where TomlSource::where(const toml::node& node) const {
  const toml::source_position& at = node.source().begin;
  return {name, at.line, at.column + (node.is_string() ? 1u : 0u)};
}

const toml::node* TableReader::get(std::string_view key) {
  known_.push_back(key);
  return table_.get(key);
}

bool TableReader::read(std::string_view key, std::string& value) {
  const toml::node* node = get(key);
  if (!node) return false;
  if (auto text = node->value_exact<std::string>()) {
    value = *text;
    return true;
  }
  source_.error(*node, fmt::format("'{}' must be a text", key));
  return false;
}

bool TableReader::read(std::string_view key, bool& value) {
  const toml::node* node = get(key);
  if (!node) return false;
  if (auto truth = node->value_exact<bool>()) {
    value = *truth;
    return true;
  }
  source_.error(*node, fmt::format("'{}' must be true or false", key));
  return false;
}

bool TableReader::read(std::string_view key, double& value) {
  const toml::node* node = get(key);
  if (!node) return false;
  if (auto number = node->is_number() ? node->value<double>() : std::nullopt) {
    value = *number;
    return true;
  }
  source_.error(*node, fmt::format("'{}' must be a number", key));
  return false;
}

const toml::table* TableReader::table(std::string_view key) {
  const toml::node* node = get(key);
  if (!node) return nullptr;
  if (!node->is_table()) source_.error(*node, fmt::format("'{}' must be a table", key));
  return node->as_table();
}

const toml::array* TableReader::array(std::string_view key) {
  const toml::node* node = get(key);
  if (!node) return nullptr;
  if (!node->is_array()) source_.error(*node, fmt::format("'{}' must be a list", key));
  return node->as_array();
}

void TableReader::finish() {
  for (const auto& [key, node] : table_) {
    const std::string_view name = key.str();
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    std::string text = fmt::format("unknown key '{}'", name);
    if (std::string_view near = nearest_name(name, known_); !near.empty())
      text += fmt::format("; did you mean '{}'?", near);
    const toml::source_region& r = key.source();
    source_.diags.error({source_.file, r.begin.line, r.begin.column, r.end.column}, text);
  }
}

std::vector<std::pair<std::string, const toml::node*>> in_file_order(const toml::table& table) {
  std::vector<std::pair<std::string, const toml::node*>> entries;
  for (const auto& [key, node] : table)
    entries.emplace_back(std::string(key.str()), &node);
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    const toml::source_position &p = a.second->source().begin, &q = b.second->source().begin;
    return std::pair(p.line, p.column) < std::pair(q.line, q.column);
  });
  return entries;
}

namespace {

bool read_number(const toml::node& node, RawValue& raw) {
  if (auto truth = node.value_exact<bool>())
    raw.numbers.push_back(*truth ? 1.0f : 0.0f);
  else if (node.is_number())
    raw.numbers.push_back(static_cast<float>(*node.value<double>()));
  else
    return false;
  return true;
}

/// An inner list; all of them must have the same length.
bool read_inner(const toml::array& inner, RawValue& raw) {
  if (raw.inner != 0 && raw.inner != inner.size()) return false;
  raw.inner = static_cast<uint32_t>(inner.size());
  return std::all_of(inner.begin(), inner.end(), [&](const toml::node& n) { return read_number(n, raw); });
}

} // namespace

bool read_raw(const toml::node& node, const TomlSource& source, RawValue& raw) {
  raw.where = source.where(node);
  if (auto text = node.value_exact<std::string>()) {
    raw.strings.push_back(*text);
    return true;
  }
  if (read_number(node, raw)) return true;
  bool ok = node.is_array();
  if (const toml::array* list = node.as_array()) {
    raw.list = true;
    for (const toml::node& item : *list) {
      if (const toml::array* inner = item.as_array())
        ok = ok && read_inner(*inner, raw);
      else if (auto text = item.value_exact<std::string>())
        raw.strings.push_back(*text);
      else
        ok = ok && raw.inner == 0 && read_number(item, raw);
    }
    ok = ok && (raw.strings.empty() || raw.numbers.empty());
  }
  if (!ok)
    source.error(node,
                 "a value is a number, a text, or a list of numbers, of texts or of equally long lists");
  return ok;
}

} // namespace slvm::sltest

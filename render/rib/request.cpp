// The table of requests.def as data, its argument lists parsed once.
#include "render/rib/request.h"

#include "slvm/support/diagnostics.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

namespace render {

namespace {

/// One "kind:name?" or "kind[n]:name?" of a row; the rows are our own text, so anything unknown is a bug
/// there.
ArgumentInfo parse_argument(std::string_view text) {
  ArgumentInfo info;
  if (text.ends_with('?')) {
    info.optional = true;
    text.remove_suffix(1);
  }
  size_t colon = text.find(':');
  std::string_view kind = text.substr(0, colon);
  info.name = colon == std::string_view::npos ? kind : text.substr(colon + 1);
  if (kind == "float") {
    info.kind = ArgumentKind::kFloat;
  } else if (kind == "int") {
    info.kind = ArgumentKind::kInt;
  } else if (kind == "string") {
    info.kind = ArgumentKind::kString;
  } else if (kind == "handle") {
    info.kind = ArgumentKind::kHandle;
  } else if (kind == "basis") {
    info.kind = ArgumentKind::kBasis;
  } else if (kind == "dash") {
    info.kind = ArgumentKind::kDash;
  } else if (kind == "int[]") {
    info.kind = ArgumentKind::kInts;
    info.count = 0;
  } else if (kind == "string[]") {
    info.kind = ArgumentKind::kStrings;
    info.count = 0;
  } else {
    info.kind = ArgumentKind::kFloats;
    info.count = 0;
    size_t bracket = kind.find('[') + 1;
    std::from_chars(kind.data() + bracket, kind.data() + kind.size() - 1, info.count);
  }
  return info;
}

void parse_row(RequestInfo& row, std::string_view arguments, std::string_view where) {
  bool flat = true;
  while (!arguments.empty()) {
    size_t blank = std::min(arguments.find(' '), arguments.size());
    std::string_view word = arguments.substr(0, blank);
    arguments.remove_prefix(std::min(blank + 1, arguments.size()));
    if (word == "params") {
      row.params = true;
      continue;
    }
    const ArgumentInfo& a = row.arguments.emplace_back(parse_argument(word));
    bool numeric = a.kind == ArgumentKind::kFloat || a.kind == ArgumentKind::kInt ||
                   (a.kind == ArgumentKind::kFloats && a.count > 0);
    flat = flat && numeric && !a.optional;
    row.flat_count += a.count;
  }
  if (!flat) row.flat_count = 0;
  row.outside = where.find('o') != std::string_view::npos;
  row.world = where.find('w') != std::string_view::npos;
}

struct Table {
  std::vector<RequestInfo> rows;
  std::map<std::string_view, const RequestInfo*> by_name;
  std::vector<std::string_view> names;

  Table() {
    rows.reserve(kRequestCount);
#define REQUEST(name, arguments, where, lacks, doc)                                                          \
  rows.push_back({RequestId::k##name, #name, {}, false, false, false, lacks, doc, 0});                       \
  parse_row(rows.back(), arguments, where);
#include "render/rib/requests.def"
#undef REQUEST
    for (const RequestInfo& row : rows) {
      by_name[row.name] = &row;
      names.push_back(row.name);
    }
  }
};

const Table& table() {
  static const Table kTable;
  return kTable;
}

} // namespace

std::span<const RequestInfo> requests() {
  return table().rows;
}

const RequestInfo& request_info(RequestId id) {
  return table().rows[static_cast<size_t>(id)];
}

const RequestInfo* find_request(std::string_view name) {
  auto it = table().by_name.find(name);
  return it == table().by_name.end() ? nullptr : it->second;
}

std::string_view suggest_request(std::string_view name) {
  return slvm::nearest_name(name, table().names);
}

void Argument::clear() {
  numbers.clear();
  ints.clear();
  strings.clear();
  where = {};
  present = false;
}

const Param* RequestCall::find_param(std::string_view token) const {
  auto it = std::find_if(params.begin(), params.end(), [&](const Param& p) {
    std::string_view t = p.token; // inline declarations: the name is the last word
    size_t blank = t.find_last_of(" \t\n");
    return (blank == std::string_view::npos ? t : t.substr(blank + 1)) == token;
  });
  return it == params.end() ? nullptr : &*it;
}

bool RequestCall::holds_data() const {
  if (id != RequestId::kArchiveBegin) return false;
  const Param* type = find_param("Content-Type");
  const bool rib = !type || !type->is_string() || type->strings[0] == "application/rib";
  return !rib || find_param("Content-Transfer-Encoding");
}

} // namespace render

#include "slc/tools/diagnostics_json.h"

#include <nlohmann/json.hpp>

namespace slc {
namespace {

using nlohmann::ordered_json;

ordered_json place(slvm::SourceRange r, const slvm::SourceManager& sources) {
  ordered_json out;
  out["file"] = sources.name(r.file);
  if (r.line) out["line"] = r.line;
  if (r.column) {
    out["column"] = r.column;
    out["end"] = std::max(r.end, r.column + 1);
  }
  return out;
}

} // namespace

std::string diagnostics_json(const slvm::Diagnostics& diags, const slvm::SourceManager& sources) {
  std::string out;
  for (const slvm::Diagnostic& d : diags.sorted()) {
    ordered_json object;
    object["severity"] = d.severity == slvm::Severity::kError ? "error" : "warning";
    object["message"] = d.text;
    if (!d.warning_name.empty()) object["warning"] = d.warning_name;
    if (d.where.file || d.where.line) object["at"] = place(d.where, sources);
    for (slvm::SourceRange r = sources.included_from(d.where.file); r.valid();
         r = sources.included_from(r.file))
      object["included_from"].push_back(place(r, sources));
    for (const slvm::Note& note : d.notes) {
      ordered_json n;
      n["message"] = note.text;
      if (note.where.file || note.where.line) n["at"] = place(note.where, sources);
      object["notes"].push_back(std::move(n));
    }
    for (const slvm::FixIt& fix : d.fixits)
      object["fixits"].push_back({{"at", place(fix.where, sources)}, {"replacement", fix.replacement}});
    // Names and texts may hold bytes that are no UTF-8.
    out += object.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
  }
  if (uint32_t dropped = diags.errors_dropped())
    out += ordered_json{{"errors_not_shown", dropped}}.dump() + "\n";
  return out;
}

} // namespace slc

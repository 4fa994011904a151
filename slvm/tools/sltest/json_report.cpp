#include "slvm/tools/sltest/json_report.h"

#include <nlohmann/json.hpp>

namespace slvm::sltest {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "anemone-sltest";
constexpr int kVersion = 1;

void add_place(Json& object, const Where& where) {
  if (where.file.empty()) return;
  object["file"] = where.file;
  if (where.line) object["line"] = where.line;
}

Json bench_json(const BenchResult& r) {
  Json object{{"name", r.name}};
  if (!r.error.empty()) {
    object["error"] = r.error;
    return object;
  }
  object["points"] = r.points;
  object["runs"] = r.runs;
  object["ns_per_point"] = r.ns_per_point();
  object["median_seconds"] = r.median;
  object["best_seconds"] = r.best;
  object["compile_seconds"] = r.compile;
  object["bind_seconds"] = r.bind;
  return object;
}

Json case_json(const CaseReport& r) {
  Json object{{"name", r.test->name}};
  add_place(object, r.test->where);
  object["status"] = r.passed() ? "passed" : "failed";
  object["runs"] = r.runs;
  object["seconds"] = r.seconds;
  object["failures"] = Json::array();
  for (const CheckFailure& f : r.failures) {
    Json failure{{"text", f.text}};
    add_place(failure, f.where);
    object["failures"].push_back(std::move(failure));
  }
  for (const std::string& file : r.updated)
    object["updated"].push_back(file);
  for (const BenchResult& bench : r.bench)
    object["bench"].push_back(bench_json(bench));
  return object;
}

Json coverage_json(const FileCoverage& f) {
  Json object{{"file", f.file}, {"lines", Json::array()}, {"branches", Json::array()}};
  for (const auto& [line, points] : f.lines)
    object["lines"].push_back({{"line", line}, {"points", points}});
  for (const BranchCoverage& b : f.branches)
    object["branches"].push_back(
        {{"line", b.line}, {"column", b.column}, {"what", b.what}, {"true", b.yes}, {"false", b.no}});
  return object;
}

} // namespace

std::string json_text(const std::deque<FileReport>& reports, const std::vector<FileCoverage>* coverage) {
  Json root{
      {"schema", kSchema}, {"version", kVersion}, {"passed", all_passed(reports)}, {"files", Json::array()}};
  for (const FileReport& report : reports) {
    Json file{{"file", report.file.name}, {"cases", Json::array()}};
    if (report.unreadable) file["unreadable"] = true;
    for (const CaseReport& r : report.cases)
      file["cases"].push_back(case_json(r));
    root["files"].push_back(std::move(file));
  }
  if (coverage) {
    root["coverage"] = Json::array();
    for (const FileCoverage& f : *coverage)
      root["coverage"].push_back(coverage_json(f));
  }
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace slvm::sltest

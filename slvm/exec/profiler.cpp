// Time goes from one instruction's beginning to the next one's; what counting itself takes is left out.
#include "slvm/exec/profiler.h"

#include <algorithm>
#include <set>

namespace slvm {

void Profiler::charge() {
  const Clock::time_point now = Clock::now();
  if (!running_.empty() && running_.back().cell)
    running_.back().cell->seconds += std::chrono::duration<double>(now - since_).count();
}

bool Profiler::before(const ExecutionStep& step) {
  charge();
  Running& running = running_.back();
  running.cell = &running.table->cells[step.code()];
  running.cell->points += step.active_points();
  ++running.cell->instructions;
  running.cell->call = step.call() != nullptr;
  since_ = Clock::now();
  return true;
}

void Profiler::begin_run(const Instance& instance) {
  charge();
  const Program& program = instance.program();
  Table& table = tables_[instance.id()];
  if (table.cells.empty()) table = {std::vector<Cell>(program.code.size()), program.lines, program.files};
  running_.push_back({&table, nullptr});
  since_ = Clock::now();
}

void Profiler::end_run(const Instance&) {
  charge();
  running_.pop_back();
  since_ = Clock::now();
}

void Profiler::collect(std::map<Key, ProfileLine>& lines) const {
  auto add = [&](const ProfileLine& l) {
    ProfileLine& sum =
        lines.try_emplace({l.file, l.line}, ProfileLine{l.file, l.line, 0, 0, 0}).first->second;
    sum.seconds += l.seconds;
    sum.points += l.points;
    sum.instructions += l.instructions;
  };
  for (const auto& [key, line] : merged_)
    add(line);
  for (const auto& [id, table] : tables_) {
    // A line ran as often as the busiest of its calls, or, where there are none, of its instructions.
    std::map<Key, ProfileLine> own;
    std::set<Key> with_calls;
    Program places;
    places.lines = table.lines;
    places.files = table.files;
    for (uint32_t code = 0; code < table.cells.size(); ++code) {
      const Cell& cell = table.cells[code];
      if (!cell.instructions) continue;
      const SourcePlace place = place_of(places, code);
      ProfileLine& line = own[{std::string(place.file), place.line}];
      line.file = place.file;
      line.line = place.line;
      line.seconds += cell.seconds;
      if (cell.call && with_calls.insert({line.file, line.line}).second) line.points = 0;
      if (cell.call || !with_calls.contains({line.file, line.line}))
        line.points = std::max(line.points, cell.points);
      line.instructions += cell.instructions;
    }
    for (const auto& [key, line] : own)
      add(line);
  }
}

std::vector<ProfileLine> Profiler::lines() const {
  std::map<Key, ProfileLine> all;
  collect(all);
  std::vector<ProfileLine> list;
  for (auto& [key, line] : all)
    list.push_back(std::move(line));
  std::stable_sort(list.begin(), list.end(),
                   [](const ProfileLine& a, const ProfileLine& b) { return a.seconds > b.seconds; });
  return list;
}

void Profiler::merge(const Profiler& other) {
  other.collect(merged_);
}

} // namespace slvm

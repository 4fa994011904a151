// Where shaders spend their time, by line of source. PUBLIC. One for each context; add up those of several
// threads by merge().
//
//   slvm::Profiler profiler;
//   context.observe(&profiler);
//   context.shade(shaders, grid);
//   for (const slvm::ProfileLine& line : profiler.lines()) ...
#pragma once

#include "slvm/exec/observer.h"

#include <chrono>
#include <map>
#include <string>

namespace slvm {

struct ProfileLine {
  std::string file;
  uint32_t line = 0;         ///< 0: what has no place in the source
  double seconds = 0;        ///< of the line itself; lights it runs have lines of their own
  uint64_t points = 0;       ///< how often it ran, counted for each point
  uint64_t instructions = 0; ///< dispatched, each for many points
};

class Profiler final : public ExecutionObserver {
public:
  bool before(const ExecutionStep&) override;
  void begin_run(const Instance&) override;
  void end_run(const Instance&) override;

  /// The lines that ran, slowest first.
  std::vector<ProfileLine> lines() const;
  void merge(const Profiler& other);

private:
  using Clock = std::chrono::steady_clock;
  struct Cell {
    double seconds = 0;
    uint64_t points = 0, instructions = 0;
    bool call = false;
  };
  /// By word of code; instances may be gone when the lines are asked for.
  struct Table {
    std::vector<Cell> cells;
    std::vector<LineEntry> lines;
    std::vector<std::string> files;
  };
  using Key = std::pair<std::string, uint32_t>;
  void charge();
  void collect(std::map<Key, ProfileLine>& lines) const;

  std::map<uint64_t, Table> tables_; ///< by instance
  struct Running {
    Table* table;
    Cell* cell;
  };
  std::vector<Running> running_; ///< the innermost run last
  Clock::time_point since_;
  std::map<Key, ProfileLine> merged_;
};

} // namespace slvm

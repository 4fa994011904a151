// Marks in a checked program: calls that compute nothing, by which an observer of the run learns where in the
// source it is and what variables hold there. A mark is a call of printf whose pattern begins with a byte
// that no source has; MarkObserver (mark_observer.h) takes such calls and leaves them out.
//
//   statements   a mark before each statement
//   conditions   the condition of an if, loop or ?: becomes f(condition), where f hands it to a mark and
//   returns it reads        each local without initialiser has a second variable that tells whether it was
//   set; reads hand
//                that to a mark
//   probe        a mark with the value of one variable behind one line
#pragma once

#include "slc/compiler.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace slvm::sltest {

enum class MarkKind : uint8_t { kStatement, kCondition, kRead, kProbe };

struct Mark {
  MarkKind kind = MarkKind::kStatement;
  std::string file;
  uint32_t line = 0, column = 0;
  std::string name; ///< of the variable read or probed
  auto operator<=>(const Mark&) const = default;
};

/// FILE:LINE:NAME. The file may be given without its folder.
struct ProbeTarget {
  std::string file;
  uint32_t line = 0;
  std::string name;
};

struct InstrumentOptions {
  bool statements = false, conditions = false, right_sides = false, reads = false;
  std::optional<ProbeTarget> probe = {};
};

/// The pattern of marks: this, and the number of the mark.
inline constexpr char kMarkByte = '\x01';

/// One for all programs of a session: the same place has the same mark in all of them.
class Instrumenter {
public:
  explicit Instrumenter(InstrumentOptions options);
  Instrumenter(const Instrumenter&) = delete;

  void instrument(slc::CheckedSource& checked, const SourceManager& sources);

  /// Differs between all instrumenters; never 0.
  uint64_t id() const { return id_; }
  const InstrumentOptions& options() const { return options_; }
  const std::vector<Mark>& marks() const { return marks_; }
  /// The variable whose value is computed at this place, or "".
  std::string variable_at(std::string_view file, uint32_t line, uint32_t column) const;
  /// The text of a source file that was marked.
  const std::map<std::string, std::string>& files() const { return files_; }
  /// False: all shaders so far came compiled, so that there was nothing to mark.
  bool met_sources() const { return met_sources_; }
  /// Why there is no mark for the probe; "": there is one.
  std::string probe_problem() const { return probe_found_ ? "" : probe_problem_; }

private:
  friend class Marker;
  uint32_t number_of(Mark mark);

  uint64_t id_;
  InstrumentOptions options_;
  std::vector<Mark> marks_;
  std::map<Mark, uint32_t> numbers_;
  std::map<std::tuple<std::string, uint32_t, uint32_t>, std::string> variables_;
  std::map<std::string, std::string> files_;
  bool probe_found_ = false; ///< in one of the shaders; the others do not matter
  std::string probe_problem_;
  bool met_sources_ = false;
};

} // namespace slvm::sltest

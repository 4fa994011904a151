// Errors, warnings and notes: collected while a compiler, loader or parser runs, printed once, in source
// order. PUBLIC. Libraries report into a Diagnostics; only mains print.
//
//   plastic.sl:12:15: error: no 'smoothstep' takes (color, float, float)
//      12 |     float w = smoothstep(Cs, 0.2, 0.8);
//         |               ^~~~~~~~~~
//   note: candidate: float smoothstep(float min, float max, float x)
//
// A message about an included file names those that include it, outermost last; a fix that is known for
// certain stands under the caret.
#pragma once

#include "slvm/support/source.h"

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slvm {

enum class Severity : uint8_t { kNote, kWarning, kError };

struct Note {
  SourceRange where; // may be nowhere: the note is then printed without file and line
  std::string text;
};

/// A change of the source that mends what the message is about.
struct FixIt {
  SourceRange where; ///< what is replaced
  std::string replacement;
};

struct Diagnostic {
  Severity severity = Severity::kError;
  SourceRange where;
  std::string text;
  std::string warning_name; // "unused" for -Wunused; empty for errors
  std::vector<Note> notes;
  std::vector<FixIt> fixits;
};

/// Collects diagnostics of one run. Not thread-safe: one per compilation.
class Diagnostics {
public:
  /// Errors past this many are counted, not kept; 0: all are kept.
  uint32_t error_limit = 20;
  bool warnings_are_errors = false;
  bool no_warnings = false;
  /// Names of warnings switched off (-Wno-NAME).
  std::set<std::string, std::less<>> disabled;

  /// Returns the diagnostic just added, so that notes can be attached; the reference is valid until the next
  /// call.
  Diagnostic& error(SourceRange where, std::string text);
  Diagnostic& warning(SourceRange where, std::string_view name, std::string text);

  /// `#pragma nolint`: drops warnings on the given line, from now on and backwards.
  void silence_line(FileId file, uint32_t line);

  bool has_errors() const { return error_count_ > 0; }
  /// The same without warnings that `warnings_are_errors` made errors: something cannot be understood.
  bool has_true_errors() const { return error_count_ > promoted_; }
  uint32_t error_count() const { return error_count_; }
  /// Calls f(Diagnostic&) for each of those kept, to add to them.
  template <class F> void for_each(F&& f) {
    for (Diagnostic& d : list_)
      f(d);
  }
  /// Errors that were counted only.
  uint32_t errors_dropped() const {
    return error_limit && error_count_ > error_limit ? error_count_ - error_limit : 0;
  }
  /// All kept diagnostics in source order (file order of first report, then line, then column; stable).
  std::vector<Diagnostic> sorted() const;

private:
  std::vector<Diagnostic> list_;
  std::set<std::pair<FileId, uint32_t>> silenced_;
  Diagnostic scrap_;                        // receives notes for diagnostics that were dropped
  uint32_t error_count_ = 0, promoted_ = 0; // all of them, and those that were warnings
};

/// The text form shown above, ready for stderr. `colour`: ANSI colours for a terminal.
std::string format_diagnostics(const Diagnostics&, const SourceManager&, bool colour = false);

/// The candidate nearest to `name` by edit distance (at most 2, 1 for names of 3 letters, and less than the
/// name's length); empty if none.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates);

} // namespace slvm

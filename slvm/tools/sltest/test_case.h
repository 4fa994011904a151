// A case of a test file: a setup and what is expected of it. Plain data; docs/sltest.md describes the file
// format.
#pragma once

#include "slvm/tools/sltest/setup.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slvm::sltest {

/// A number passes when it is off by no more than abs, or than rel times the expected one.
struct Tolerance {
  double abs = 1e-6, rel = 1e-5;
};

enum class Check : uint8_t {
  kAll,       ///< the value at every point
  kAt,        ///< the value at point (iu, iv)
  kPoints,    ///< a value for each point
  kMean,      ///< of all points, by component
  kMin,       ///< smallest of all points, by component
  kMax,       ///< largest of all points, by component
  kCode,      ///< RSL code gives the value at each point
  kPredicate, ///< an RSL condition holds at each point
};

struct Expectation {
  Check check = Check::kAll;
  std::string variable; ///< none for kPredicate
  RawValue value;       ///< for kCode and kPredicate the code
  int iu = 0, iv = 0;   ///< for kAt
  Tolerance tolerance;
};

/// When a result counts as the same picture; the names and values of OSL's test suite.
struct ImageTolerance {
  double failthresh = 0.004, hardfail = 0.01, failpercent = 0.02, failrelative = 0.001;
};

struct ImageExpectation {
  std::string variable, file; ///< the file relative to the test file
  ImageTolerance tolerance;
  Where where;
};

enum class SweepTarget : uint8_t { kParam, kVariable, kAttribute, kOption };

/// A name that takes several values, one after another.
struct Sweep {
  SweepTarget target = SweepTarget::kParam;
  Declaration what;
  std::vector<RawValue> values;
};

/// `columns` and `rows`: a table of arguments and results of an expression. The columns are declarations; the
/// last one holds the results.
struct Table {
  std::vector<Declaration> columns;
  std::vector<std::vector<RawValue>> rows;
};

struct Case {
  std::string name;
  Where where;
  Setup setup;
  std::vector<Sweep> sweeps;
  std::vector<Expectation> expectations;
  std::vector<ImageExpectation> images;
  std::optional<std::string> printed;
  std::optional<std::vector<std::string>> messages; ///< a part of each run-time message, in order
  std::optional<std::vector<std::string>> warnings; ///< a part of each warning of the compiler, in order
  std::string bind_error, compile_error;            ///< a part of the expected message; "" none expected
  std::optional<Table> table;
  Tolerance tolerance;
  ImageTolerance image_tolerance;
  bool quick = false;      ///< run in one configuration only
  bool specialised = true; ///< false: only in configurations that do not specialise; see docs/sltest.md
  bool unspecialised = true;
};

struct TestFile {
  std::string name;
  std::vector<Case> cases;
};

} // namespace slvm::sltest

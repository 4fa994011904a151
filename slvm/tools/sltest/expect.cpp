#include "slvm/tools/sltest/expect.h"

#include "slvm/tools/sltest/deviation.h"
#include "slvm/tools/sltest/expression.h"
#include "slvm/tools/sltest/predicate.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace slvm::sltest {
namespace {

/// Smallest, largest or mean value of all points, by component; means in double.
std::vector<float> summary(const Variable& v, Check check) {
  std::vector<float> result(v.planes());
  for (size_t k = 0; k < result.size(); ++k) {
    double sum = 0;
    float low = v.get(k, 0), high = low;
    for (size_t i = 0; i < v.points(); ++i) {
      const float x = v.get(k, i);
      sum += x;
      low = std::isnan(x) ? x : std::min(low, x);
      high = std::isnan(x) ? x : std::max(high, x);
    }
    const float mean = static_cast<float>(sum / static_cast<double>(v.points()));
    result[k] = check == Check::kMean ? mean : check == Check::kMin ? low : high;
  }
  return result;
}

/// For predicates and code: parameters that the case gives are variables, too.
Prepared with_params(const Case& c, const Prepared& prepared) {
  Prepared named = prepared;
  for (const Setting& s : c.setup.shader.params) {
    const Declaration d = inferred_type(s.value, s.what);
    auto value = to_value(s.value, *d.type, d.elements);
    if (value && d.name != kResultName && !named.grid.find(d.name))
      named.grid.set(uniform_variable(d.name, *value));
  }
  return named;
}

class Checker {
public:
  Checker(const Case& c, const Prepared& prepared, const RunResult& result, ShaderLibrary& library)
      : case_(c), prepared_(prepared), result_(result), library_(library), named_(with_params(c, prepared)) {}

  std::vector<CheckFailure> run() {
    for (const Expectation& e : case_.expectations) {
      if (e.check == Check::kPredicate)
        check_predicate(e);
      else
        check_variable(e);
    }
    if (case_.printed && *case_.printed != result_.printed)
      fail(case_.where, fmt::format("printf: expected \"{}\", got \"{}\"", *case_.printed, result_.printed));
    check_messages();
    return std::move(failures_);
  }

private:
  void fail(const Where& where, std::string text) {
    while (text.ends_with('\n'))
      text.pop_back();
    failures_.push_back({where, std::move(text)});
  }

  void check_variable(const Expectation& e) {
    const Variable* v = result_.find(e.variable);
    if (!v) v = prepared_.grid.find(e.variable);
    if (!v)
      return fail(e.value.where,
                  fmt::format("{}: the shader has no such output; it has {}", e.variable, names()));
    if (v->type == Type::kString) return check_text(e, *v);
    Deviation deviation(e.tolerance);
    std::string error = compare(e, *v, deviation);
    if (!error.empty()) return fail(e.value.where, fmt::format("{}: {}", e.variable, error));
    if (deviation.ok()) return;
    const char* what = e.check == Check::kMean  ? " mean"
                       : e.check == Check::kMin ? " minimum"
                       : e.check == Check::kMax ? " maximum"
                                                : "";
    fail(e.value.where, fmt::format("{}{}: {}", e.variable, what, deviation.text(prepared_.grid)));
  }

  void check_text(const Expectation& e, const Variable& v) {
    if (v.strings != e.value.strings)
      fail(e.value.where, fmt::format("{}: expected \"{}\", got \"{}\"", e.variable,
                                      fmt::join(e.value.strings, "\", \""), fmt::join(v.strings, "\", \"")));
  }

  /// Compares as the check asks; the error is about the expectation itself.
  std::string compare(const Expectation& e, const Variable& v, Deviation& deviation) {
    const GridData& grid = prepared_.grid;
    if (e.check == Check::kPoints) {
      auto planes = to_planes(e.value, v.type, grid.points());
      if (!planes) return planes.error();
      const Variable expected{v.name, v.type, 0, true, *planes, {}};
      for (size_t i = 0; i < grid.points(); ++i)
        deviation.add(i, expected.at(i), v.at(i));
      return "";
    }
    if (e.check == Check::kCode) {
      CodeOptions options = code_options(e.value, case_.setup.path);
      options.types = {v.type};
      auto expected = evaluate_code(library_, e.value.strings.at(0), named_.grid, prepared_.scene, options);
      if (!expected) return expected.error();
      for (size_t i = 0; i < grid.points(); ++i)
        deviation.add(i, expected->at(i), v.at(i));
      return "";
    }
    auto value = to_value(e.value, v.type, v.elements);
    if (!value) return value.error();
    const std::vector<float>& expected = value->numbers;
    if (e.check == Check::kAt) {
      if (e.iu >= grid.nu || e.iv >= grid.nv)
        return fmt::format("the grid has no point ({}, {})", e.iu, e.iv);
      const size_t point =
          static_cast<size_t>(e.iv) * static_cast<size_t>(grid.nu) + static_cast<size_t>(e.iu);
      deviation.add(point, expected, v.at(point));
    } else if (e.check == Check::kAll) {
      for (size_t i = 0; i < grid.points(); ++i)
        deviation.add(i, expected, v.at(i));
    } else {
      deviation.add(0, expected, summary(v, e.check));
    }
    return "";
  }

  void check_predicate(const Expectation& e) {
    auto holds = evaluate_predicate(library_, e.value, named_, result_, case_.setup.path);
    if (!holds) return fail(e.value.where, fmt::format("predicate: {}", holds.error()));
    size_t failed = 0, first = 0;
    for (size_t i = prepared_.grid.points(); i-- > 0;)
      if (!(*holds)[i]) {
        ++failed;
        first = i;
      }
    if (!failed) return;
    std::string text =
        fmt::format("predicate '{}' fails at {} of {} points, first at {}", e.value.strings.at(0), failed,
                    prepared_.grid.points(), point_text(prepared_.grid, first));
    for (const Variable& v : result_.outputs)
      if (mentions(e.value.strings[0], v.name) && !v.numbers.empty())
        text += fmt::format("; {} = {}", v.name, exact_text(v.at(first)));
    fail(e.value.where, text);
  }

  void check_messages() {
    std::vector<std::string> texts, described;
    for (const RuntimeMessage& m : result_.messages) {
      texts.push_back(m.text);
      described.push_back(
          fmt::format("{}:{}: {} ({} of {} points)", m.file, m.line, m.text, m.points, m.total));
    }
    check_parts("run-time message", texts, described, case_.messages.value_or(std::vector<std::string>()));
    if (case_.warnings) check_parts("warning", result_.warnings, result_.warnings, *case_.warnings);
  }

  /// Each text has the part that is expected of it, and there are no more and no fewer.
  void check_parts(const char* what, const std::vector<std::string>& got,
                   const std::vector<std::string>& described, const std::vector<std::string>& expected) {
    for (size_t i = 0; i < std::max(got.size(), expected.size()); ++i) {
      if (i >= got.size())
        fail(case_.where, fmt::format("no {} \"{}\"", what, expected[i]));
      else if (i >= expected.size())
        fail(case_.where, fmt::format("{}: {}", what, described[i]));
      else if (got[i].find(expected[i]) == std::string::npos)
        fail(case_.where, fmt::format("{}: expected \"{}\", got \"{}\"", what, expected[i], got[i]));
    }
  }

  std::string names() const {
    std::string text;
    for (const Variable& v : result_.outputs)
      text += (text.empty() ? "" : ", ") + v.name;
    return text.empty() ? "none" : text;
  }

  const Case& case_;
  const Prepared& prepared_;
  const RunResult& result_;
  ShaderLibrary& library_;
  const Prepared named_;
  std::vector<CheckFailure> failures_;
};

bool same_bits(float a, float b) {
  return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b) || (std::isnan(a) && std::isnan(b));
}

std::string variable_difference(const Variable& a, const Variable& b, const GridData& grid, double relative) {
  if (a.strings != b.strings)
    return fmt::format("{}: \"{}\" and \"{}\"", a.name, fmt::join(a.strings, "\", \""),
                       fmt::join(b.strings, "\", \""));
  const size_t points = std::max(a.points(), b.points());
  Deviation deviation({relative, relative});
  for (size_t i = 0; i < points && !a.numbers.empty(); ++i) {
    const std::vector<float> p = a.at(i), q = b.at(i);
    if (relative == 0 && !std::equal(p.begin(), p.end(), q.begin(), q.end(), same_bits))
      return fmt::format("{}: {} and {} at {}", a.name, numbers_text(p, 9), numbers_text(q, 9),
                         point_text(grid, i));
    if (relative > 0) deviation.add(i, p, q);
  }
  return deviation.ok() ? "" : fmt::format("{}: {}", a.name, deviation.text(grid));
}

bool same_message(const RuntimeMessage& a, const RuntimeMessage& b) {
  return a.text == b.text && a.line == b.line && a.points == b.points && a.total == b.total;
}

} // namespace

std::vector<CheckFailure> check(const Case& c, const Prepared& prepared, const RunResult& result,
                                ShaderLibrary& library) {
  return Checker(c, prepared, result, library).run();
}

std::string difference(const RunResult& a, const RunResult& b, const GridData& grid, double relative) {
  for (const Variable& v : a.outputs) {
    const Variable* other = b.find(v.name);
    if (!other) return v.name + " is missing";
    if (std::string text = variable_difference(v, *other, grid, relative); !text.empty()) return text;
  }
  if (a.printed != b.printed) return fmt::format("printf: \"{}\" and \"{}\"", a.printed, b.printed);
  if (!std::equal(a.messages.begin(), a.messages.end(), b.messages.begin(), b.messages.end(), same_message))
    return fmt::format("{} and {} run-time messages, or their texts or counts", a.messages.size(),
                       b.messages.size());
  return "";
}

} // namespace slvm::sltest

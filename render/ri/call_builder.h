// From arguments in C to a RequestCall: which kind each argument has is known from requests.def. What cannot
// be is remembered, and said by problem().
#pragma once

#include "render/ri/parameters.h"
#include "render/ri/size_tracker.h"
#include "render/rib/ri_error.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace render::ri {

// Arguments that a plain value does not tell.
struct Ints {
  const RtInt* values;
  RtInt count;
};
struct Floats {
  const RtFloat* values;
  RtInt count;
};
struct Texts {
  const RtToken* values;
  RtInt count;
};
struct Point { ///< three float arguments
  const RtFloat* values;
};
struct Basis { ///< by name where it is a known one
  const RtFloat (*matrix)[4];
};
struct Filter {
  RtFilterFunc function;
};
struct Handle {
  RtPointer handle;
};
struct Optional { ///< a text or a null pointer
  RtToken text;
};
struct Dash { ///< the argument "-", or none
  bool present;
};
struct LeftOut {};
struct Vertices { ///< no argument, but what sizes follow from
  RtInt count;
};

struct CallProblem {
  RiError kind = RiError::kNone;
  std::string text;
};

class CallBuilder {
public:
  CallBuilder(RequestId id, slvm::SourceRange where);

  // In the order of the request's arguments.
  void add(RtFloat value);
  void add(RtInt value);
  void add(RtToken text);
  void add(Ints);
  void add(Floats);
  void add(Texts);
  void add(Point);
  void add(Basis);
  void add(Filter);
  void add(Handle);
  void add(Optional);
  void add(Dash);
  void add(LeftOut) { ++next_; }
  void add(Vertices v);

  /// The list that follows, as long as the tracker says. A parameter with a problem is left out, and `report`
  /// hears of it.
  template <class Report> void params(const ParameterList& list, const SizeTracker& tracker, Report report) {
    SizesOfRequest sizes = sizes_for(list, tracker);
    for (RtInt i = 0; i < list.count && problem_.text.empty(); ++i)
      if (CallProblem p = param(list.tokens[i], list.values[i], sizes.sizes, tracker); !p.text.empty())
        report(p);
  }

  const RequestCall& call() const { return call_; }
  /// Why the request cannot be made; no text: it can.
  const CallProblem& problem() const { return problem_; }

private:
  Argument& next();
  const ArgumentInfo& info() const { return call_.info().arguments[next_]; }
  void fail(RiError kind, std::string text);
  bool check(const void* values, RtInt count);
  SizesOfRequest sizes_for(const ParameterList& list, const SizeTracker& tracker);
  CallProblem param(RtToken token, RtPointer values, const ClassSizes& sizes, const SizeTracker& tracker);

  RequestCall call_;
  size_t next_ = 0;
  std::optional<size_t> vertices_;
  CallProblem problem_;
};

/// The sum of counts, negative ones left out: a later check names them.
RtInt sum(const RtInt* counts, RtInt n);
/// The same for one of two interleaved rows of n counts, `first` being 0 or 1.
RtInt sum_of_every_second(const RtInt* counts, RtInt n, int first);

} // namespace render::ri

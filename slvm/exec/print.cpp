// printf and format: %f %e %g float, %d %i float as an integer, %p %v %n triple, %c color, %m matrix, %s
// string, %%. Width and precision hold for each number. Triples and matrices print as numbers separated by
// spaces.
#include "slvm/exec/run.h"

#include <bit>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/printf.h>

namespace slvm {
namespace {

constexpr int kWidest = 1000; // of a field: "%999999999f" must not fill the memory

/// A piece of a pattern: literal text, or a conversion.
struct Piece {
  std::string text; ///< literal, or "%5.2" before the letter
  char conversion = 0;
};

std::vector<Piece> split(std::string_view pattern) {
  std::vector<Piece> pieces(1);
  for (size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '%') {
      pieces.back().text += pattern[i];
      continue;
    }
    size_t end = i + 1;
    while (end < pattern.size() && (std::isdigit(static_cast<unsigned char>(pattern[end])) ||
                                    std::string_view("-+ .#").find(pattern[end]) != std::string_view::npos))
      ++end;
    if (end == pattern.size()) {
      pieces.back().text += pattern.substr(i);
      break;
    }
    if (pattern[end] == '%') {
      pieces.back().text += '%';
    } else {
      pieces.push_back({std::string(pattern.substr(i, end - i)), pattern[end]});
      pieces.emplace_back();
    }
    i = end;
  }
  return pieces;
}

// The flags, width and precision of a conversion, cut to what is sensible.
std::string numeric_format(const std::string& spec, char letter) {
  std::string out;
  for (size_t i = 0; i < spec.size();) {
    if (!std::isdigit(static_cast<unsigned char>(spec[i])) || (spec[i] == '0' && i == 1)) {
      out += spec[i++];
      continue;
    }
    size_t end = i;
    while (end < spec.size() && std::isdigit(static_cast<unsigned char>(spec[end])))
      ++end;
    out += end - i > 4 ? std::to_string(kWidest)
                       : std::to_string(std::min(std::atoi(spec.substr(i, end - i).c_str()), kWidest));
    i = end;
  }
  return out + letter;
}

std::string number(const std::string& spec, char conversion, float x) {
  if (conversion != 'd' && conversion != 'i') {
    char letter = conversion == 'e' || conversion == 'g' ? conversion : 'f';
    return fmt::sprintf(numeric_format(spec, letter), static_cast<double>(x));
  }
  double whole = std::isfinite(x) ? std::trunc(static_cast<double>(x)) : 0;
  if (std::fabs(whole) < 9e18) return fmt::sprintf(numeric_format(spec, 'd'), static_cast<long long>(whole));
  return fmt::sprintf(numeric_format(spec.find('.') == spec.npos ? spec + ".0" : spec, 'f'), whole);
}

bool fits(char conversion, Type t) {
  switch (conversion) {
  case 'f':
  case 'e':
  case 'g':
  case 'd':
  case 'i': return t == Type::kFloat;
  case 'p':
  case 'v':
  case 'n':
  case 'c': return is_triple(t);
  case 'm': return t == Type::kMatrix;
  case 's': return t == Type::kString;
  default: return false;
  }
}

class Formatter {
public:
  explicit Formatter(const GridCall& call) : call_(call), strings_(call.run.state.machine.strings()) {
    first_ = call.operands[0].store ? 1 : 0;
    pieces_ = split(strings_.text(std::bit_cast<uint32_t>(*call.operands[first_].planes.data)));
  }

  std::string text(size_t lane) {
    std::string out;
    size_t next = first_ + 1;
    for (const Piece& piece : pieces_) {
      if (!piece.conversion)
        out += piece.text;
      else if (next >= call_.operands.size())
        out += complain(piece, "has no value");
      else
        out += convert(piece, call_.operands[next++], lane);
    }
    return out;
  }

private:
  std::string convert(const Piece& piece, const GridOperand& o, size_t lane) {
    if (!fits(piece.conversion, o.type))
      return complain(piece, fmt::format("does not fit a {}", type_name(o.type)));
    size_t at = o.planes.step ? lane : 0;
    if (o.type == Type::kString)
      return fmt::sprintf(numeric_format(piece.text, 's'),
                          std::string(strings_.text(std::bit_cast<uint32_t>(o.planes.data[at]))));
    std::string out;
    for (size_t c = 0; c < static_cast<size_t>(components(o.type)); ++c) {
      if (c) out += ' ';
      out += number(piece.text, piece.conversion, o.planes.plane(c)[at]);
    }
    return out;
  }

  std::string complain(const Piece& piece, std::string_view what) {
    if (!complained_)
      call_.run.report(call_.code, MessageSeverity::kError,
                       fmt::format("{}: {}{} {}", call_.info.name, piece.text, piece.conversion, what), 1);
    complained_ = true;
    return piece.text + piece.conversion;
  }

  const GridCall& call_;
  StringPool& strings_;
  std::vector<Piece> pieces_;
  size_t first_;
  bool complained_ = false;
};

} // namespace

namespace grid_ops {

void print(const GridCall& call) {
  Formatter formatter(call);
  std::string text;
  mask_for_each(call.run.mask.current(), call.run.points, [&](size_t lane) { text += formatter.text(lane); });
  if (!text.empty()) call.run.state.services.print(call.run.shading_state(), text);
}

namespace {

/// The text of the first point of those that run, and how many run.
struct First {
  explicit First(const GridCall& call) {
    const MaskWord* mask = call.run.mask.current();
    count = mask_count(mask, call.run.points);
    if (count == 0) return;
    size_t lane = 0;
    while (!mask_test(mask, lane))
      ++lane;
    text = Formatter(call).text(lane);
  }
  size_t count;
  std::string text;
};

// One message for all points. The machine folds those of other grids that read the same.
void print_message(const GridCall& call, MessageSeverity severity) {
  First first(call);
  if (first.count > 0) call.run.report(call.code, severity, std::move(first.text), first.count);
}

} // namespace

void print_once(const GridCall& call) {
  First first(call);
  if (!first.text.empty()) call.run.state.services.print(call.run.shading_state(), first.text);
}

void print_error(const GridCall& call) {
  print_message(call, MessageSeverity::kError);
}
void print_warning(const GridCall& call) {
  print_message(call, MessageSeverity::kWarning);
}

void format(const GridCall& call) {
  uint32_t id = call.run.state.machine.strings().intern(Formatter(call).text(0));
  std::fill_n(call.operands[0].planes.data, kMaxLanes, std::bit_cast<float>(id));
}

} // namespace grid_ops
} // namespace slvm

// The RIB writer: the kinds of requests.def once more, now from values to tokens.
#include "render/rib/writer.h"

#include "render/rib/write_tokens.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace render {

namespace {

constexpr size_t kWidth = 100; ///< of a line; longer ones go on in the next

bool opens(RequestId id) {
  std::string_view name = request_info(id).name;
  return name.ends_with("Begin");
}
bool closes(RequestId id) {
  std::string_view name = request_info(id).name;
  return name.ends_with("End");
}
bool is_branch(RequestId id) {
  return id == RequestId::kElseIf || id == RequestId::kElse;
}
bool is_number_name(std::string_view text) {
  constexpr size_t kDigits = 9; // an int
  bool digits = std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits && !text.empty() && text.size() <= kDigits && (text == "0" || text[0] != '0');
}

} // namespace

RibWriter::RibWriter(std::function<void(std::string_view)> out, RibFormat format)
    : out_(std::move(out)), format_(format) {}

/// The line every file begins with, unless it is the comment at hand.
void RibWriter::header(bool own) {
  if (!has_header_ && !own) out_("##RenderMan RIB\n");
  has_header_ = true;
}

/// The same for the first request.
void RibWriter::version(bool own) {
  if (!has_version_ && !own) out_("version 3.04\n");
  has_version_ = true;
}

void RibWriter::begin_line() {
  line_.clear();
  wrapped_ = 0;
  if (!format_.binary) line_.append(2 * static_cast<size_t>(std::max(depth_, 0)), ' ');
}

void RibWriter::end_line() {
  line_ += '\n';
  out_(line_);
}

void RibWriter::request(const RequestCall& call) {
  const RequestInfo& info = call.info();
  header(false);
  version(call.id == RequestId::kversion);
  if (closes(call.id) || is_branch(call.id)) depth_ = std::max(depth_ - 1, 0);
  // The end of content that is no RIB is looked for as text.
  bool binary = std::exchange(format_.binary, format_.binary && data_name_.empty());
  begin_line();
  name(info);
  for (size_t i = 0; i < info.arguments.size(); ++i)
    if (call.arguments[i].present) argument(info.arguments[i], call.arguments[i]);
  for (const Param& p : call.params)
    param(p);
  if (call.id == RequestId::kArchiveEnd && !call.has(0) && !data_name_.empty()) text(data_name_);
  data_name_.clear();
  format_.binary = binary;
  end_line();
  if (opens(call.id) || is_branch(call.id)) ++depth_;
  if (!call.holds_data()) return;
  // Content that is no RIB stands as it is, up to a line with the archive's end.
  out_(call.data);
  if (!call.data.empty() && !call.data.ends_with('\n')) out_("\n");
  data_name_ = call.text(0);
}

void RibWriter::unknown_request(std::string_view, std::string_view, slvm::SourceRange) {}

void RibWriter::comment(std::string_view text, slvm::SourceRange) {
  header(text.starts_with("#RenderMan RIB"));
  begin_line();
  line_ += '#';
  for (char c : text) // it must stay one line
    line_ += c == '\n' || c == '\r' ? ' ' : c;
  end_line();
}

void RibWriter::verbatim(std::string_view text) {
  header(false);
  version(false);
  out_(text);
  if (!text.ends_with('\n')) out_("\n");
}

void RibWriter::name(const RequestInfo& info) {
  if (!format_.binary) {
    line_ += info.name;
    return;
  }
  auto index = static_cast<size_t>(info.id);
  auto code = static_cast<unsigned char>(index);
  if (!defined_[index]) append_request_definition(line_, code, info.name);
  defined_[index] = true;
  append_encoded_request(line_, code);
}

void RibWriter::argument(const ArgumentInfo& info, const Argument& a) {
  switch (info.kind) {
  case ArgumentKind::kFloat: real(a.numbers[0]); break;
  case ArgumentKind::kInt: integer(a.ints[0]); break;
  case ArgumentKind::kString: text(a.strings[0]); break;
  case ArgumentKind::kFloats: reals(a.numbers); break;
  case ArgumentKind::kInts: integers(a.ints); break;
  case ArgumentKind::kStrings: texts(a.strings); break;
  case ArgumentKind::kHandle:
    if (is_number_name(a.strings[0]))
      integer(std::stoi(a.strings[0]));
    else
      text(a.strings[0]);
    break;
  case ArgumentKind::kBasis:
    if (a.strings.empty())
      reals(a.numbers);
    else
      text(a.strings[0]);
    break;
  case ArgumentKind::kDash: line_ += " -"; break;
  }
}

void RibWriter::param(const Param& p) {
  text(p.token);
  if (p.is_string()) {
    texts(p.strings);
  } else if (!p.integers) {
    reals(p.numbers, true);
  } else {
    space();
    line_ += '[';
    for (float v : p.numbers)
      whole(v);
    line_ += ']';
  }
}

/// Before a token: a blank, or in a line that is long enough a line end.
void RibWriter::space() {
  if (format_.binary) return;
  if (line_.size() - wrapped_ > kWidth) {
    line_ += '\n';
    wrapped_ = line_.size();
    line_.append(2 * static_cast<size_t>(std::max(depth_, 0)) + 4, ' ');
  } else if (!line_.ends_with('[')) {
    line_ += ' ';
  }
}

void RibWriter::real(float value) {
  space();
  if (format_.binary)
    append_encoded_real(line_, value);
  else if (value == std::trunc(value) && std::abs(value) < 1e6f && !(value == 0 && std::signbit(value)))
    append_whole(line_, value); // a float to its reader all the same
  else
    append_real(line_, value, format_.precision);
}

void RibWriter::whole(float value) {
  if (!std::isfinite(value)) { // an integer too long for a float
    real(value);
    return;
  }
  constexpr float kLargest = 1 << 24;
  bool exact = std::abs(value) <= kLargest && !(value == 0 && std::signbit(value));
  if (format_.binary && exact) {
    append_encoded_integer(line_, static_cast<int>(value));
  } else {
    space();
    if (format_.binary) line_ += ' '; // between ASCII numbers
    append_whole(line_, value);
  }
}

void RibWriter::integer(int value) {
  space();
  if (format_.binary)
    append_encoded_integer(line_, value);
  else
    line_ += std::to_string(value);
}

void RibWriter::text(std::string_view value) {
  space();
  if (format_.binary)
    append_encoded_string(line_, value);
  else
    append_string(line_, value);
}

/// `told`: a reader must see that they are reals, so one of them has a point.
void RibWriter::reals(std::span<const float> values, bool told) {
  space();
  if (format_.binary) {
    append_encoded_reals(line_, values);
    return;
  }
  line_ += '[';
  bool shown = !told || values.empty();
  for (float v : values) {
    size_t before = line_.size();
    real(v);
    shown = shown || line_.find_first_of(".e", before) != std::string::npos;
  }
  if (!shown) line_ += ".0";
  line_ += ']';
}

void RibWriter::integers(std::span<const int> values) {
  space();
  line_ += '[';
  for (int v : values)
    integer(v);
  line_ += ']';
}

void RibWriter::texts(std::span<const std::string> values) {
  space();
  line_ += '[';
  for (const std::string& v : values)
    text(v);
  line_ += ']';
}

} // namespace render

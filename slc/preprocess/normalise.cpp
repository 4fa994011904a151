// Clean-up of source text, line by line.
#include "slc/preprocess/normalise.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

namespace slc {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// The text with LF line ends, control characters blanked and a final LF.
std::string plain_lines(std::string_view text) {
  std::string out;
  out.reserve(text.size() + 1);
  size_t i = 0;
  if (text.substr(0, 3) == "\xEF\xBB\xBF") {
    out = "   ";
    i = 3;
  }
  for (; i < text.size(); ++i) {
    char c = text[i];
    if (c == '\r') {
      if (i + 1 < text.size() && text[i + 1] == '\n') continue;
      c = '\n';
    }
    bool control = (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
    out += control ? ' ' : c;
  }
  if (out.empty() || out.back() != '\n') out += '\n';
  return out;
}

// `\` followed by blanks only continues a line all the same: the backslash moves to the end.
void move_backslash_to_end(char* begin, char* end) {
  char* last = end;
  while (last != begin && is_blank(last[-1]))
    --last;
  if (last != end && last != begin && last[-1] == '\\') {
    last[-1] = ' ';
    end[-1] = '\\';
  }
}

// Blanks [p, end) up to a comment.
void blank_until_comment(char* p, char* end) {
  for (; p != end; ++p) {
    if (*p == '/' && p + 1 != end && (p[1] == '/' || p[1] == '*')) return;
    if (*p != '\\' || p + 1 != end) *p = ' ';
  }
}

// Whether anything but a comment or a continuation follows on the line.
bool has_word(const char* p, const char* end) {
  while (p != end && (is_blank(*p) || *p == '\\'))
    ++p;
  bool comment = p != end && *p == '/' && p + 1 != end && (p[1] == '/' || p[1] == '*');
  return p != end && !comment;
}

constexpr std::string_view kDirectives[] = {"include", "define", "undef", "if",    "ifdef",
                                            "ifndef",  "elif",   "else",  "endif", "error",
                                            "warning", "line",   "pragma"};

enum class DirectiveFix { kNone, kInsertLine };

// Mends one directive line in place. kInsertLine: it is a line marker that lacks the word "line" after the
// '#'.
DirectiveFix fix_directive(char* begin, char* end, std::string_view& name) {
  char* p = begin;
  while (p != end && is_blank(*p))
    ++p;
  if (p == end || *p != '#') return DirectiveFix::kNone;
  ++p;
  while (p != end && is_blank(*p))
    ++p;
  char* word = p;
  while (p != end && is_letter(*p))
    ++p;
  name = {word, static_cast<size_t>(p - word)};
  if (name == "endif" || name == "else") blank_until_comment(p, end);
  if (name == "pragma" && !has_word(p, end)) { // Wave crashes on it
    std::fill(begin, p, ' ');
    name = {};
    return DirectiveFix::kNone;
  }
  if (!name.empty() || p == end || !is_digit(*p)) return DirectiveFix::kNone;
  // A marker: `# number "file" flags`; the flags go.
  while (p != end && is_digit(*p))
    ++p;
  while (p != end && *p != '"')
    ++p;
  if (p != end) ++p;
  while (p != end && *p != '"')
    ++p;
  if (p != end) blank_until_comment(p + 1, end);
  return DirectiveFix::kInsertLine;
}

} // namespace

std::string normalise_source(std::string_view source, OpenEnds* open) {
  std::string text = plain_lines(source);
  std::string out;
  out.reserve(text.size());
  bool in_comment = false; // of the /* */ kind, at the start of the line
  size_t number = 0, comment_line = 0;
  std::vector<std::pair<size_t, std::string>> conditionals; // around this line
  for (size_t begin = 0; begin < text.size();) {
    size_t end = text.find('\n', begin);
    ++number;
    char* line = text.data() + begin;
    char* line_end = text.data() + end;
    if (!in_comment) {
      move_backslash_to_end(line, line_end);
      std::string_view directive;
      DirectiveFix fix = fix_directive(line, line_end, directive);
      if (directive == "if" || directive == "ifdef" || directive == "ifndef")
        conditionals.emplace_back(number, directive);
      if (directive == "endif" && !conditionals.empty()) conditionals.pop_back();
      bool known = directive.empty() || std::find(std::begin(kDirectives), std::end(kDirectives),
                                                  directive) != std::end(kDirectives);
      if (!known && conditionals.empty()) {
        if (open) open->unknown.emplace_back(number, directive);
        std::fill(line, line_end, ' ');
      }
      if (fix == DirectiveFix::kInsertLine) {
        size_t hash = text.find('#', begin);
        out.append(text, begin, hash + 1 - begin);
        out += "line ";
        begin = hash + 1;
      }
    }
    bool in_string = false;
    for (char* p = line; p < line_end; ++p) {
      if (in_comment) {
        if (p[0] == '*' && p[1] == '/') in_comment = false, ++p;
      } else if (in_string) {
        if (*p == '\\')
          ++p;
        else if (*p == '"')
          in_string = false;
      } else if (*p == '"') {
        in_string = true;
      } else if (p[0] == '/' && p[1] == '/') {
        break;
      } else if (p[0] == '/' && p[1] == '*') {
        in_comment = true;
        comment_line = number;
        ++p;
      }
    }
    out.append(text, begin, end + 1 - begin);
    begin = end + 1;
  }
  if (in_comment) out.insert(out.size() - 1, "*/");
  if (open) {
    open->comment = in_comment ? comment_line : 0;
    open->conditionals = conditionals.size();
    if (!conditionals.empty()) std::tie(open->conditional, open->conditional_word) = conditionals.back();
  }
  return out;
}

} // namespace slc

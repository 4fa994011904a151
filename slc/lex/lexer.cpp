// The lexer. Read Lexer::next_token first.
#include "slc/lex/lexer.h"

#include "slc/diag/messages.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <utility>

namespace slc {

using slvm::SourceRange;

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_name_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_name(char c) {
  return is_name_start(c) || is_digit(c);
}

struct Punctuator {
  std::string_view text;
  TokenKind kind;
};
// Longer ones first.
constexpr Punctuator kPunctuators[] = {
    {"===", TokenKind::kForeign},    {"!==", TokenKind::kForeign},    {"=<", TokenKind::kForeign},
    {"=>", TokenKind::kForeign},     {"<>", TokenKind::kForeign},     {"<<", TokenKind::kForeign},
    {">>", TokenKind::kForeign},     {"**", TokenKind::kForeign},     {"%=", TokenKind::kForeign},
    {"^=", TokenKind::kForeign},     {"&=", TokenKind::kForeign},     {"|=", TokenKind::kForeign},
    {"->", TokenKind::kArrow},       {"+=", TokenKind::kPlusAssign},  {"-=", TokenKind::kMinusAssign},
    {"*=", TokenKind::kStarAssign},  {"/=", TokenKind::kSlashAssign}, {"==", TokenKind::kEqual},
    {"!=", TokenKind::kNotEqual},    {"<=", TokenKind::kLessEqual},   {">=", TokenKind::kGreaterEqual},
    {"&&", TokenKind::kAnd},         {"||", TokenKind::kOr},          {"++", TokenKind::kForeign},
    {"--", TokenKind::kForeign},     {"+", TokenKind::kPlus},         {"-", TokenKind::kMinus},
    {"*", TokenKind::kStar},         {"/", TokenKind::kSlash},        {".", TokenKind::kDot},
    {"^", TokenKind::kCaret},        {"=", TokenKind::kAssign},       {"<", TokenKind::kLess},
    {">", TokenKind::kGreater},      {"!", TokenKind::kNot},          {"?", TokenKind::kQuestion},
    {":", TokenKind::kColon},        {"(", TokenKind::kLeftParen},    {")", TokenKind::kRightParen},
    {"{", TokenKind::kLeftBrace},    {"}", TokenKind::kRightBrace},   {"[", TokenKind::kLeftBracket},
    {"]", TokenKind::kRightBracket}, {",", TokenKind::kComma},        {";", TokenKind::kSemicolon},
    {"%", TokenKind::kForeign},      {"&", TokenKind::kForeign},      {"|", TokenKind::kForeign},
    {"~", TokenKind::kForeign},
};

// Words behind which an expression starts, so that ".5" there is a number.
bool precedes_expression(std::string_view word) {
  constexpr std::string_view kWords[] = {"return", "else",   "float",  "color", "point",
                                         "vector", "normal", "matrix", "string"};
  return std::find(std::begin(kWords), std::end(kWords), word) != std::end(kWords);
}

class Lexer {
public:
  Lexer(const PreprocessedText& input, slvm::Diagnostics& diags)
      : input_(input), text_(input.text), diags_(diags) {}

  TokenList run() {
    while (next_token()) {
    }
    Token end;
    end.range = range(text_.empty() ? 0 : text_.size() - 1, text_.size());
    end.text = "end of file";
    push(std::move(end));
    return std::move(out_);
  }

private:
  char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  bool next_token();
  void lex_pragma();
  void lex_number();
  void lex_name();
  void lex_string();
  void lex_char_string();
  bool lex_typographic();
  void end_unterminated(std::string& value, size_t begin);
  void lex_punctuator();
  size_t take_escape(std::string& value);
  void push(Token token);
  Token make(TokenKind kind, size_t begin) const;
  SourceRange range(size_t begin, size_t end) const;
  bool after_operand() const;
  bool is_decrement(size_t at) const;

  const PreprocessedText& input_;
  std::string_view text_;
  slvm::Diagnostics& diags_;
  TokenList out_;
  size_t at_ = 0;
  mutable size_t piece_ = 0; // the one `range` found last: offsets mostly grow
  bool line_start_ = true;
  bool nolint_ = false;
  bool skipped_ = false; // characters without meaning, since the last token
  bool unknown_pragma_reported_ = false;
};

SourceRange Lexer::range(size_t begin, size_t end) const {
  const std::vector<Piece>& pieces = input_.pieces;
  if (pieces.empty()) return {};
  if (pieces[piece_].offset > begin) piece_ = 0;
  while (piece_ + 1 < pieces.size() && pieces[piece_ + 1].offset <= begin)
    ++piece_;
  const Piece& piece = pieces[piece_];
  SourceRange r = piece.at;
  if (piece.exact) {
    r.column += static_cast<uint32_t>(begin - piece.offset);
    r.end = r.column + static_cast<uint32_t>(end - begin);
  }
  return r;
}

Token Lexer::make(TokenKind kind, size_t begin) const {
  Token token;
  token.kind = kind;
  token.range = range(begin, at_);
  token.text = std::string(text_.substr(begin, at_ - begin));
  return token;
}

void Lexer::push(Token token) {
  token.after_error = std::exchange(skipped_, false);
  if (nolint_) {
    token.after_nolint = true;
    diags_.silence_line(token.range.file, token.range.line);
    nolint_ = false;
  }
  out_.tokens.push_back(std::move(token));
}

bool Lexer::next_token() {
  while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) {
    if (text_[at_] == '\n') line_start_ = true;
    ++at_;
  }
  if (at_ >= text_.size()) return false;
  char c = peek();
  if (c == '/' && peek(1) == '/') { // left over behind a string without end
    at_ = std::min(text_.find('\n', at_), text_.size());
    return true;
  }
  bool line_start = std::exchange(line_start_, false);
  if (c == '#' && line_start)
    lex_pragma();
  else if (is_digit(c) || (c == '.' && is_digit(peek(1)) && !after_operand()))
    lex_number();
  else if (is_name_start(c))
    lex_name();
  else if (c == '"')
    lex_string();
  else if (c == '\'')
    lex_char_string();
  else if (static_cast<unsigned char>(c) < 0x80 || !lex_typographic())
    lex_punctuator();
  return true;
}

bool Lexer::after_operand() const {
  if (out_.tokens.empty()) return false;
  const Token& last = out_.tokens.back();
  return last.kind == TokenKind::kNumber || last.kind == TokenKind::kRightParen ||
         last.kind == TokenKind::kRightBracket ||
         (last.kind == TokenKind::kIdentifier && !precedes_expression(last.text));
}

// "#pragma" words to the end of the line; no other directive gets this far.
void Lexer::lex_pragma() {
  size_t begin = at_, end = std::min(text_.find('\n', at_), text_.size());
  SourceRange where = range(begin, end);
  PreprocessedText line{std::string(text_.substr(begin + 1, end - begin - 1)), {{0, where, false}}, {}, {}};
  at_ = end;
  std::vector<Token> words = lex(line, diags_).tokens;
  words.pop_back();
  std::string_view name = words.size() > 1 ? std::string_view(words[1].text) : std::string_view();
  if (name == "nolint") {
    nolint_ = true;
  } else if (name == "annotation" && words.size() == 4 && words[2].kind == TokenKind::kString &&
             words[3].kind == TokenKind::kString) {
    out_.annotations.push_back({words[2].text, words[3].text, where});
  } else if (name == "annotation") {
    report(diags_, Msg::kBadAnnotation, where);
  } else if (!std::exchange(unknown_pragma_reported_, true)) {
    report(diags_, Msg::kUnknownPragma, where, name);
  }
}

void Lexer::lex_number() {
  size_t begin = at_;
  auto skip_digits = [&] {
    while (is_digit(peek()))
      ++at_;
  };
  bool hex = peek() == '0' && (peek(1) == 'x' || peek(1) == 'X');
  skip_digits();
  bool integer = true;
  if (peek() == '.') {
    integer = false;
    ++at_;
    skip_digits();
  }
  size_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
  if ((peek() == 'e' || peek() == 'E') && is_digit(peek(1 + sign))) {
    integer = false;
    at_ += 1 + sign;
    skip_digits();
  }
  Token token = make(TokenKind::kNumber, begin);
  token.is_integer = integer;
  auto result = std::from_chars(token.text.data(), token.text.data() + token.text.size(), token.number);
  if (result.ec == std::errc::result_out_of_range) {
    // Too large or too small: from_chars leaves the value alone.
    double wide = 0;
    std::from_chars(token.text.data(), token.text.data() + token.text.size(), wide);
    token.number = wide > 1 ? std::numeric_limits<float>::max() : 0.0f;
    report(diags_, Msg::kNumberRange, token.range, token.text);
  }
  if (is_name(peek())) {
    while (is_name(peek()))
      ++at_;
    Token whole = make(TokenKind::kNumber, begin);
    std::string_view suffix = std::string_view(whole.text).substr(token.text.size());
    if (hex)
      report(diags_, Msg::kHexNumber, whole.range, whole.text);
    else if (suffix == "f" || suffix == "F")
      report(diags_, Msg::kFloatSuffix, whole.range, whole.text);
    else
      report(diags_, Msg::kBadNumber, whole.range, whole.text);
    token.range = whole.range;
    token.text = whole.text;
  }
  push(std::move(token));
}

void Lexer::lex_name() {
  size_t begin = at_;
  while (is_name(peek()))
    ++at_;
  push(make(TokenKind::kIdentifier, begin));
}

void Lexer::lex_string() {
  size_t begin = at_++;
  std::string value;
  while (peek() != '"' && peek() != '\n' && at_ < text_.size()) {
    if (peek() == '\\') {
      size_t escape = at_;
      if (!take_escape(value))
        report(diags_, Msg::kUnknownEscape, range(escape, at_), text_.substr(escape, at_ - escape));
    } else {
      value += text_[at_++];
    }
  }
  bool closed = peek() == '"';
  if (closed)
    ++at_;
  else
    end_unterminated(value, begin);
  Token token = make(TokenKind::kString, begin);
  token.text = std::move(value);
  token.unterminated = !closed;
  if (!closed) report(diags_, Msg::kUnterminatedString, token.range);
  push(std::move(token));
}

// A string without end has taken the rest of its line. What closes the line, `) {` or `);`, is given back,
// and a comment: so the error stays alone.
void Lexer::end_unterminated(std::string& value, size_t begin) {
  size_t end = std::min(text_.substr(0, at_).find("//", begin + 1), at_);
  while (end > begin + 1 && std::string_view(" \t,;(){}").find(text_[end - 1]) != std::string_view::npos)
    --end;
  value.resize(value.size() - std::min(value.size(), at_ - end));
  at_ = end;
}

// 'text', which other languages take for a string.
void Lexer::lex_char_string() {
  size_t begin = at_, end = text_.substr(0, text_.find('\n', at_)).find('\'', at_ + 1);
  if (end == std::string_view::npos) {
    ++at_;
    return void(report(diags_, Msg::kBadCharacter, range(begin, at_), text_.substr(begin, 1)));
  }
  at_ = end + 1;
  Token token = make(TokenKind::kString, begin);
  token.text = std::string(text_.substr(begin + 1, end - begin - 1));
  report(diags_, Msg::kSingleQuotes, token.range)
      .fixits.push_back({token.range, fmt::format("\"{}\"", token.text)});
  push(std::move(token));
}

// Quotes and dashes of word processors, and blanks of web pages: a message, and on with what is meant.
bool Lexer::lex_typographic() {
  struct Sign {
    std::string_view bytes, meant;
  };
  constexpr Sign kSigns[] = {
      {"\xE2\x80\x9C", "\""}, {"\xE2\x80\x9D", "\""}, {"\xE2\x80\x9E", "\""}, {"\xE2\x80\x98", "\""},
      {"\xE2\x80\x99", "\""}, {"\xE2\x80\x93", "-"},  {"\xE2\x80\x94", "-"},  {"\xE2\x88\x92", "-"},
      {"\xC3\x97", "*"},      {"\xC2\xB7", "."},      {"\xE2\x89\xA4", "<="}, {"\xE2\x89\xA5", ">="},
      {"\xE2\x89\xA0", "!="}, {"\xC2\xA0", " "},
  };
  auto sign_at = [&](size_t at) {
    auto starts = [&](const Sign& sign) { return text_.substr(at, sign.bytes.size()) == sign.bytes; };
    auto found = std::find_if(std::begin(kSigns), std::end(kSigns), starts);
    return found == std::end(kSigns) ? nullptr : found;
  };
  const Sign* sign = sign_at(at_);
  if (!sign) return false;
  size_t begin = at_;
  at_ += sign->bytes.size();
  report(diags_, Msg::kTypographic, range(begin, at_), text_.substr(begin, at_ - begin), sign->meant);
  if (sign->meant == " ") return true;
  if (sign->meant == "\"") { // up to the next quote of any kind
    size_t line_end = std::min(text_.find('\n', at_), text_.size()), end = at_, after = line_end;
    for (; end < line_end; ++end) {
      const Sign* close = sign_at(end);
      if (text_[end] != '"' && !(close && close->meant == "\"")) continue;
      after = end + (close ? close->bytes.size() : 1);
      break;
    }
    std::string value(text_.substr(at_, end - at_));
    at_ = after;
    Token token = make(TokenKind::kString, begin);
    token.text = std::move(value);
    push(std::move(token));
    return true;
  }
  for (const Punctuator& p : kPunctuators)
    if (p.text == sign->meant) push(make(p.kind, begin));
  return true;
}

// Reads `\x`, appends its value. 0: an unknown escape, whose letter is taken as it is.
size_t Lexer::take_escape(std::string& value) {
  constexpr std::string_view kLetters = "ntrbf\\\"'", kValues = "\n\t\r\b\f\\\"'";
  ++at_;
  char c = peek();
  if (c >= '0' && c <= '7') {
    int code = 0, digits = 0;
    for (; digits < 3 && peek() >= '0' && peek() <= '7'; ++digits)
      code = code * 8 + (text_[at_++] - '0');
    value += static_cast<char>(code);
    return static_cast<size_t>(digits);
  }
  if (at_ >= text_.size() || c == '\n') return 1;
  ++at_;
  size_t found = kLetters.find(c);
  value += found == std::string_view::npos ? c : kValues[found];
  return found == std::string_view::npos ? 0 : 1;
}

// The language has no `--`: `a--b` and `--1` are two signs. Only where C would mean a decrement it is one
// token, for the message.
bool Lexer::is_decrement(size_t at) const {
  const size_t next = text_.find_first_not_of(" \t\n", at + 2);
  if (next == std::string_view::npos) return true;
  const char c = text_[next];
  if (is_digit(c) || c == '.' || c == '(') return false;
  return !(is_name_start(c) && after_operand());
}

void Lexer::lex_punctuator() {
  size_t begin = at_;
  for (const Punctuator& p : kPunctuators) {
    if (text_.substr(at_, p.text.size()) != p.text) continue;
    if (p.text == "--" && !is_decrement(at_)) continue;
    at_ += p.text.size();
    push(make(p.kind, begin));
    return;
  }
  // A run of bytes outside ASCII is one character, or a few: one message.
  bool foreign = static_cast<unsigned char>(peek()) >= 0x80;
  skipped_ = true;
  do
    ++at_;
  while (foreign && static_cast<unsigned char>(peek()) >= 0x80);
  if (foreign)
    report(diags_, Msg::kForeignCharacter, range(begin, at_));
  else
    report(diags_, Msg::kBadCharacter, range(begin, at_), text_.substr(begin, 1));
}

} // namespace

TokenList lex(const PreprocessedText& text, slvm::Diagnostics& diags) {
  return Lexer(text, diags).run();
}

} // namespace slc

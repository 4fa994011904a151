// The wrapper around Boost.Wave: files come from the FileReader, errors go to Diagnostics, and each token is
// placed where the user sees it. Read preprocess() at the end first.
#include "slc/preprocess/preprocess.h"

#include "slc/diag/messages.h"
#include "slc/preprocess/normalise.h"
#include "slc/preprocess/wave.h"

#include <algorithm>
#include <filesystem>
#include <fmt/ranges.h>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <set>

namespace slc {

using slvm::FileId;
using slvm::SourceRange;
namespace wave = boost::wave;

std::optional<std::string> read_file(const std::string& path) {
  std::error_code error;
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path, error)) return std::nullopt;
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) return std::nullopt;
  return text;
}

namespace {

constexpr size_t kMaxIncludeDepth = 64;
constexpr size_t kMaxIncludes = 2000;
constexpr size_t kMaxExpansions = 200'000;

// What Wave calls the main file: any other name it would make an absolute path.
constexpr const char* kMainName = "<stdin>";

struct GiveUp {}; // thrown and caught inside this file

// A position by line, then column: order of characters in a file.
struct Place {
  FileId file = 0;
  size_t line = 0, column = 0;
};
bool before(const Place& a, const Place& b) {
  return std::pair(a.line, a.column) < std::pair(b.line, b.column);
}

// All that one run knows; the hooks and the input policy below reach it through the context.
class State {
public:
  State(const PreprocessOptions& options, slvm::SourceManager& sources, slvm::Diagnostics& diags,
        PreprocessedText& out)
      : options_(options), sources_(sources), diags_(diags), out_(out) {}

  FileId file_id(const std::string& name) {
    auto [it, added] = file_ids_.try_emplace(name, 0);
    if (added) {
      it->second = sources_.find(name);
      if (!it->second && !name.starts_with("<")) it->second = sources_.add(name, "");
    }
    return it->second;
  }
  template <class Position> Place place(const Position& p) {
    return {file_id(p.get_file().c_str()), p.get_line(), p.get_column()};
  }
  template <class Token> SourceRange range(const Token& token) {
    return word_range(place(token.get_position()), token.get_value().size());
  }
  static SourceRange word_range(Place p, size_t length) {
    auto column = static_cast<uint32_t>(p.column);
    return {p.file, static_cast<uint32_t>(p.line), column, column + static_cast<uint32_t>(length)};
  }

  void set_main(FileId main) { file_ids_[kMainName] = main; }
  void enter_file(std::string path) { open_files_.push_back(std::move(path)); }
  void leave_file() { open_files_.pop_back(); }

  // Finds, reads and keeps an included file. False: reported.
  bool locate(const std::string& name, bool system, SourceRange where, std::string& path);
  void widen_to_name(SourceRange& where, const std::string& name) const;
  std::string normalise(FileId file, std::string_view text, bool included) {
    OpenEnds open;
    std::string clean = normalise_source(text, &open);
    for (const auto& [line, word] : open.unknown) {
      constexpr std::string_view kUsual[] = {"include", "define", "undef", "ifdef",
                                             "ifndef",  "elif",   "endif", "pragma"};
      std::string_view near = slvm::nearest_name(word, kUsual);
      report(diags_, Msg::kUnknownDirective, word_range({file, line, 1}, word.size() + 1), word,
             near.empty() ? "" : fmt::format("; did you mean '#{}'?", near));
    }
    if (open.comment) report(diags_, Msg::kOpenComment, word_range({file, open.comment, 0}, 0));
    if (open.conditional && !open.comment) {
      // A header that lacks the end of its guard is harmless; a main file may have lost its shader.
      report(diags_, included ? Msg::kOpenGuard : Msg::kOpenConditional,
             word_range({file, open.conditional, 1}, open.conditional_word.size() + 1),
             open.conditional_word);
      open_conditional_ = !included;
      for (size_t i = 0; included && i < open.conditionals; ++i)
        clean += "#endif\n";
    }
    return clean;
  }
  void keep(const std::string& path, const std::string& text, SourceRange included_from) {
    FileId id = sources_.find(path);
    if (!id) id = sources_.add(path, text);
    sources_.set_included_from(id, included_from);
    file_ids_[path] = id;
    texts_[path] = normalise(id, text, true);
  }
  const std::string& normalised(const std::string& path) { return texts_[path]; }

  // Macro definitions and uses.
  template <class Token, class Tokens> void note_definition(const Token& name, const Tokens& body) {
    note_definition_line(place(name.get_position()));
    definitions_[std::string(name.get_value().c_str())] = range(name);
    for (const auto& token : body)
      note_definition_line(place(token.get_position()));
  }
  void note_use(Place start, Place end, std::string_view name);

  // Appends a token of the output.
  void emit(Place place, std::string_view text, bool is_pragma);

  /// `lost`: text after this place is lost, so that even a warning is an error.
  template <class Exception> void report_exception(const Exception& e, bool lost = false);

private:
  void note_definition_line(Place p) { definition_lines_.insert({p.file, p.line}); }
  bool in_definition(const Place& p) const { return !p.file || definition_lines_.contains({p.file, p.line}); }
  size_t real_column(const Place& p, std::string_view text);

  const PreprocessOptions& options_;
  slvm::SourceManager& sources_;
  slvm::Diagnostics& diags_;
  PreprocessedText& out_;
  std::map<std::string, FileId, std::less<>> file_ids_;
  std::vector<std::string> open_files_;
  std::map<std::string, std::string> texts_; // included files, normalised
  std::set<std::string> system_files_;       // those that -MM leaves out
  size_t include_count_ = 0, expansion_count_ = 0;
  bool open_conditional_ = false; // reported
  bool lost_if_ = false;          // an #if that was reported: its #else and #endif are no news
  std::set<std::pair<FileId, size_t>> definition_lines_;
  std::map<std::string, SourceRange, std::less<>> definitions_; // of macros, the newest of each name
  Place use_start_, use_end_;                                   // the outermost macro call being expanded
  size_t use_length_ = 0;
  Place next_;             // where a character directly behind the last one would be
  FileId column_file_ = 0; // real_column's memory: what was found last
  size_t column_line_ = 0, column_next_ = 1;
};

std::string folder_of(const std::string& path) {
  size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

// From the start of an #include line to the name in it.
void State::widen_to_name(SourceRange& where, const std::string& name) const {
  size_t at = sources_.line(where.file, where.line).find(name);
  if (name.empty() || at == std::string_view::npos || at == 0) return;
  where.column = static_cast<uint32_t>(at); // the quote before it
  where.end = static_cast<uint32_t>(at + name.size() + 2);
}

bool State::locate(const std::string& name, bool system, SourceRange where, std::string& path) {
  if (++include_count_ > kMaxIncludes) {
    report(diags_, Msg::kTooManyIncludes, where, kMaxIncludes);
    throw GiveUp{};
  }
  if (open_files_.size() > kMaxIncludeDepth) {
    report(diags_, Msg::kIncludeDepth, where, kMaxIncludeDepth);
    throw GiveUp{};
  }
  std::vector<std::string> folders;
  if (!name.starts_with("/")) {
    if (!system) folders.push_back(folder_of(open_files_.back()));
    for (const std::string& dir : options_.include_dirs)
      folders.push_back(dir.ends_with('/') ? dir : dir + "/");
  } else {
    folders.push_back("");
  }
  size_t own = folders.size();
  if (!name.starts_with("/"))
    for (const std::string& dir : options_.system_dirs)
      folders.push_back(dir.ends_with('/') ? dir : dir + "/");
  for (const std::string& folder : folders) {
    path = folder + name;
    if (texts_.contains(path)) return true;
    std::optional<std::string> text = options_.read(path);
    if (!text) continue;
    bool from_system = &folder >= folders.data() + own || system_files_.contains(open_files_.back());
    if (from_system) system_files_.insert(path);
    out_.dependencies.push_back({path, from_system});
    keep(path, *text, where);
    return true;
  }
  for (const EmbeddedText& header : options_.standard_headers) {
    if (header.name != name) continue;
    path = fmt::format("{}{}", kStandardFolder, name); // no file: no dependency either
    if (!texts_.contains(path)) keep(path, std::string(header.text), where);
    return true;
  }
  std::vector<std::string> named; // each once
  for (const std::string& folder : folders)
    if (std::find(named.begin(), named.end(), folder) == named.end()) named.push_back(folder);
  folders = std::move(named);
  for (std::string& folder : folders)
    folder = folder.empty() ? "'./'" : fmt::format("'{}'", folder);
  std::vector<std::string_view> headers;
  for (const EmbeddedText& header : options_.standard_headers)
    headers.push_back(header.name);
  std::string_view near = slvm::nearest_name(name, headers);
  report(diags_, Msg::kMissingInclude, where, name,
         near.empty() ? "" : fmt::format("; did you mean '{}'?", near),
         folders.empty() ? "no folder" : fmt::format("{}", fmt::join(folders, ", ")));
  return false;
}

void State::note_use(Place start, Place end, std::string_view name) {
  if (++expansion_count_ > kMaxExpansions) {
    report(diags_, Msg::kTooManyExpansions, word_range(use_start_, use_length_), kMaxExpansions);
    throw GiveUp{};
  }
  if (in_definition(start)) return; // a macro used inside another's body
  bool inside_arguments =
      start.file == use_start_.file && before(use_start_, start) && before(start, use_end_);
  if (inside_arguments) return;
  use_start_ = start;
  use_end_ = end;
  use_length_ = name.size();
  if (auto it = definitions_.find(name); it != definitions_.end() && it->second.file)
    out_.expansions.push_back({it->first, word_range(use_start_, use_length_), it->second});
}

// Wave goes on counting columns over a line's final backslash: find the token in its line.
size_t State::real_column(const Place& p, std::string_view text) {
  if (p.file != column_file_ || p.line != column_line_)
    column_file_ = p.file, column_line_ = p.line, column_next_ = 1;
  std::string_view line = sources_.line(p.file, static_cast<uint32_t>(p.line));
  size_t column = p.column;
  if (column == 0 || column - 1 > line.size() || line.substr(column - 1, text.size()) != text) {
    size_t found = line.find(text, column_next_ - 1);
    if (found != std::string_view::npos) column = found + 1;
  }
  column_next_ = std::min(column + text.size(), line.size() + 1);
  return column;
}

void State::emit(Place p, std::string_view text, bool is_pragma) {
  if (text.empty()) return;
  bool from_macro = in_definition(p);
  if (text == "\n") {
    out_.text += '\n';
    next_ = {};
    return;
  }
  if (is_pragma && !out_.text.empty() && out_.text.back() != '\n') out_.text += '\n';
  if (!from_macro) p.column = real_column(p, text);
  bool contiguous = !from_macro && p.file == next_.file && p.line == next_.line && p.column == next_.column;
  if (!contiguous) {
    // Tokens of different origin must not grow together.
    if (!out_.text.empty() && out_.text.back() != '\n' && out_.text.back() != ' ' && text[0] != ' ')
      out_.text += ' ';
    SourceRange at = from_macro ? word_range(use_start_, use_length_) : word_range(p, text.size());
    out_.pieces.push_back({out_.text.size(), at, !from_macro});
  }
  out_.text += text;
  size_t newline = text.rfind('\n');
  next_ = from_macro || newline != std::string_view::npos ? Place{}
                                                          : Place{p.file, p.line, p.column + text.size()};
}

template <class Exception> void State::report_exception(const Exception& e, bool lost) {
  Place p{file_id(e.file_name()), e.line_no(), e.column_no()};
  SourceRange where = word_range(p, 0);
  std::string_view text = e.description();
  size_t colon = text.find(": "); // "error: ", "fatal error: "
  if (colon != std::string_view::npos) text.remove_prefix(colon + 2);
  std::string_view subject = text.substr(std::min(text.size(), text.rfind(": ") + 2)); // what it is about
  if (open_conditional_ && text.find("#endif") != std::string_view::npos) return;
  if (text.starts_with("the #if for this directive is missing")) {
    if (!std::exchange(lost_if_, false)) report(diags_, Msg::kStrayConditional, where, subject);
    return;
  }
  lost_if_ |= text.find("expression") != std::string_view::npos || subject.starts_with("#if");
  if (text.starts_with("ill formed #include")) return void(report(diags_, Msg::kBadInclude, where));
  if (text.starts_with("too few macro"))
    return void(report(diags_, Msg::kMacroArguments, where, subject, "too few"));
  if (text.starts_with("too many macro"))
    return void(report(diags_, Msg::kMacroArguments, where, subject, "too many"));
  bool warning = !lost && e.get_severity() < wave::util::severity_error;
  report(diags_, warning ? Msg::kPreprocessorWarning : Msg::kPreprocessor, where, text);
}

// Gives Wave the text of included files.
struct ReaderPolicy {
  template <class IterContext> class inner {
  public:
    template <class Position>
    static void init_iterators(IterContext& iter, const Position&, wave::language_support language) {
      const std::string& text = iter.ctx.get_hooks().state->normalised(iter.filename.c_str());
      using Iterator = typename IterContext::iterator_type;
      iter.text_ = text;
      iter.first = Iterator(iter.text_.begin(), iter.text_.end(), Position(iter.filename), language);
      iter.last = Iterator();
    }
    std::string text_;
  };
};

struct Hooks : wave::context_policies::default_preprocessing_hooks {
  State* state = nullptr;
  bool reported = false; // the exception that follows was reported already

  template <class Context>
  bool locate_include_file(Context& ctx, std::string& file_path, bool is_system, const char*,
                           std::string& dir_path, std::string& native_name) {
    const auto& at = ctx.get_main_pos();
    SourceRange where = State::word_range(state->place(at), 0);
    state->widen_to_name(where, file_path);
    std::string path;
    if (!state->locate(file_path, is_system, where, path)) {
      reported = true;
      return false;
    }
    file_path = dir_path = native_name = path;
    return true;
  }
  template <class Context>
  void opened_include_file(const Context&, const std::string&, const std::string& path, bool) {
    state->enter_file(path);
  }
  template <class Context> void returning_from_include_file(const Context&) { state->leave_file(); }
  template <class Context, class Token, class Parameters, class Definition>
  void defined_macro(const Context&, const Token& name, bool, const Parameters&, const Definition& body,
                     bool) {
    state->note_definition(name, body);
  }
  template <class Context, class Token, class Container, class Iterator>
  bool expanding_function_like_macro(const Context&, const Token&, const std::vector<Token>&,
                                     const Container&, const Token& call,
                                     const std::vector<Container>& arguments, const Iterator&,
                                     const Iterator& end) {
    if (!arguments.empty() && defines_function(arguments[0], end)) return true;
    state->note_use(state->place(call.get_position()), state->place(end->get_position()),
                    call.get_value().c_str());
    return false;
  }
  template <class Context, class Token, class Container>
  bool expanding_object_like_macro(const Context&, const Token&, const Container&, const Token& call) {
    Place start = state->place(call.get_position());
    state->note_use(start, start, call.get_value().c_str());
    return false;
  }
  template <class Context, class Exception> void throw_exception(const Context&, const Exception& e) {
    if (std::exchange(reported, false)) return;
    if (goes_on(e))
      state->report_exception(e);
    else
      boost::throw_exception(e);
  }

private:
  // `float sqr (float x) {`: a function of a macro's name, which the definition hides. Its calls are still
  // those of the macro, which mostly means the same.
  template <class Container, class Iterator>
  static bool defines_function(const Container& first_argument, Iterator end) {
    constexpr std::string_view kBegins[] = {"float",  "color",  "point",   "vector",  "normal",
                                            "matrix", "string", "uniform", "varying", "output"};
    auto word = first_argument.begin();
    while (word != first_argument.end() && IS_CATEGORY(*word, wave::WhiteSpaceTokenType))
      ++word;
    if (word == first_argument.end()) return false;
    const std::string_view text(word->get_value().c_str(), word->get_value().size());
    if (std::find(std::begin(kBegins), std::end(kBegins), text) == std::end(kBegins)) return false;
    do
      ++end;
    while (IS_CATEGORY(*end, wave::WhiteSpaceTokenType) || IS_CATEGORY(*end, wave::EOLTokenType));
    return wave::token_id(*end) == wave::T_LEFTBRACE;
  }

  // The warnings behind which Wave's state is sound without the exception.
  static bool goes_on(const wave::preprocess_exception& e) {
    switch (e.get_errorcode()) {
    case wave::preprocess_exception::macro_redefinition:
    case wave::preprocess_exception::warning_directive:
    case wave::preprocess_exception::ill_formed_pragma_option:
    case wave::preprocess_exception::pragma_message_directive: return true;
    default: return false;
    }
  }
  static bool goes_on(const std::exception&) { return false; }
};

// A context asks localtime() for __DATE__ and __TIME__, which is not for several threads at once.
std::mutex wave_mutex;

using Token = wave::cpplexer::lex_token<>;
using Context =
    wave::context<std::string::iterator, wave::cpplexer::lex_iterator<Token>, ReaderPolicy, Hooks>;

void define_macros(Context& context, const PreprocessOptions& options) {
  auto name_of = [](const std::string& define) { return define.substr(0, define.find_first_of("=(")); };
  auto undefined = [&](const std::string& name) {
    return std::find(options.undefines.begin(), options.undefines.end(), name) != options.undefines.end();
  };
  for (const std::string& define : options.defines)
    if (!undefined(name_of(define))) context.add_macro_definition(define);
}

void run(Context& context, State& state) {
  auto token = context.begin(), end = context.end();
  bool finished = false;
  while (!finished) {
    try {
      for (; token != end; ++token) {
        std::string_view text(token->get_value().c_str(), token->get_value().size());
        auto id = wave::token_id(*token);
        bool starts_pragma = id == wave::T_PP_PRAGMA;
        if (id == wave::T_NEWLINE || id == wave::T_CPPCOMMENT) text = "\n";
        if (id == wave::T_CCOMMENT) text = " ";
        state.emit(state.place(token->get_position()), text, starts_pragma);
      }
      finished = true;
    } catch (const wave::cpplexer::lexing_exception& e) {
      finished = !e.is_recoverable();
      state.report_exception(e, finished);
    } catch (const wave::cpp_exception& e) {
      finished = !wave::is_recoverable(e);
      state.report_exception(e, finished);
    }
  }
}

} // namespace

PreprocessedText preprocess(FileId main, const PreprocessOptions& options, slvm::SourceManager& sources,
                            slvm::Diagnostics& diags) {
  PreprocessedText out;
  State state(options, sources, diags, out);
  std::string text = state.normalise(main, sources.text(main), false);
  state.set_main(main);
  state.enter_file(std::string(sources.name(main)));
  try {
    Hooks hooks;
    hooks.state = &state;
    std::optional<Context> made;
    std::unique_lock making(wave_mutex);
    Context& context = made.emplace(text.begin(), text.end(), kMainName, hooks);
    auto language = wave::support_c99;
    language = wave::enable_emit_pragma_directives(language);
    language = wave::enable_emit_line_directives(language, false);
    language = wave::enable_no_newline_at_end_of_file(language);
    language = wave::enable_no_character_validation(language);
    context.set_language(language);
    making.unlock();
    context.set_max_include_nesting_depth(2 * kMaxIncludeDepth); // locate() stops earlier
    define_macros(context, options);
    run(context, state);
  } catch (const GiveUp&) {
    // reported
  } catch (const wave::cpplexer::lexing_exception& e) {
    state.report_exception(e, true);
  } catch (const wave::cpp_exception& e) {
    state.report_exception(e, true);
  } catch (const std::exception& e) {
    report(diags, Msg::kPreprocessor, SourceRange{main, 0, 0, 0}, e.what());
  }
  return out;
}

} // namespace slc

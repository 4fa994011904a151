// docs/shadeops.md: the reference of built-in functions and variables, from the tables of slvm/format. The
// sections are those of the comments in shadeops.def, "// ---- Title".
#include "docs/pages.h"
#include "slvm/format/program.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <map>
#include <set>
#include <vector>

namespace docs {
namespace {

using namespace slvm;

struct Section {
  std::string title;
  std::vector<std::string> functions; // by name
};

bool is_public(std::string_view name) {
  for (ShadeopId id : shadeop_overloads(name))
    if (!(shadeop(id).flags & kInternal)) return true;
  return false;
}

// The sections of shadeops.def, without those that hold nothing to call.
std::vector<Section> sections() {
  constexpr std::string_view kTitle = "// ---- ";
  std::map<std::string, Section> by_title; // some come twice
  std::vector<std::string> order;
  std::set<std::string> seen;
  std::ifstream in(SHADEOPS_DEF);
  std::string title;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(kTitle)) {
      title = line.substr(kTitle.size());
      title = title.substr(0, title.find_first_of(".:"));
      if (!by_title.contains(title)) order.push_back(title);
      by_title[title].title = title;
      continue;
    }
    size_t begin = line.find("(\"");
    if (line.starts_with("//") || begin == line.npos) continue;
    std::string name = line.substr(begin + 2, line.find('"', begin + 2) - begin - 2);
    if (is_public(name) && seen.insert(name).second) by_title[title].functions.push_back(name);
  }
  std::vector<Section> list;
  for (const std::string& t : order)
    if (!by_title[t].functions.empty()) list.push_back(std::move(by_title[t]));
  return list;
}

/// "float(float x, @texture)" of "f" as "float f(float x, ...)", as one writes it.
std::string declaration(const ShadeopInfo& row) {
  std::string text(row.signature_text);
  size_t open = text.find('(');
  text = text.substr(0, open) + " " + std::string(row.name) + text.substr(open);
  for (size_t at = text.find(", @"); at != text.npos; at = text.find(", @"))
    text.replace(at, text.find(')', at) - at, ", ...");
  if (size_t at = text.find("(@"); at != text.npos) text.replace(at + 1, text.find(')', at) - at - 1, "...");
  // The channel of texture functions is written in brackets behind the name.
  if (size_t at = text.find(", uniform float channel"); at != text.npos) text.replace(at, 23, "[channel]");
  return text;
}

bool is_type(std::string_view word) {
  for (int i = 0; i < kTypeCount; ++i)
    if (type_name(static_cast<Type>(i)) == word) return true;
  return false;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (char c : text) {
    bool letter = std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    bool joined =
        letter && !words.empty() &&
        (std::isalnum(static_cast<unsigned char>(words.back().back())) || words.back().back() == '_');
    if (joined)
      words.back() += c;
    else
      words.emplace_back(1, c);
  }
  return words;
}

// Declarations that are the same but for one type, which stands at the same places in all of them.
struct Family {
  std::vector<std::string> words; // of the first
  std::set<size_t> places;        // of the type that differs
  std::vector<std::string> types;

  bool take(const std::vector<std::string>& other) {
    if (other.size() != words.size()) return false;
    std::set<size_t> differing;
    std::string type, own;
    for (size_t i = 0; i < words.size(); ++i) {
      if (words[i] == other[i]) continue;
      if (!is_type(words[i]) || !is_type(other[i])) return false;
      if (!differing.empty() && (other[i] != type || words[i] != own)) return false;
      type = other[i];
      own = words[i];
      differing.insert(i);
    }
    if (differing.empty() || (types.size() > 1 && differing != places)) return false;
    places = differing;
    if (types.empty()) types.push_back(own);
    types.push_back(type);
    return true;
  }
  std::string text() const {
    std::string out;
    for (size_t i = 0; i < words.size(); ++i)
      out += places.contains(i) ? "type" : words[i];
    return out;
  }
};

// The declarations as code, and what `type` stands for.
std::string declarations(const std::vector<std::string>& list) {
  std::vector<Family> families;
  for (const std::string& text : list) {
    std::vector<std::string> words = words_of(text);
    bool taken = false;
    for (size_t i = 0; i < families.size() && !taken; ++i)
      taken = families[i].take(words);
    if (!taken) families.push_back({std::move(words), {}, {}});
  }
  std::string out, types;
  for (const Family& family : families) {
    out += fmt::format("    {}\n", family.text());
    std::string listed = fmt::format("{}", fmt::join(family.types, ", "));
    if (!listed.empty() && types.find(listed) == types.npos) types += (types.empty() ? "" : "; or ") + listed;
  }
  return types.empty() ? out : out + fmt::format("\n`type`: {}.\n", types);
}

// A line of documentation as a sentence; a parameter's name at its beginning stays as it is.
std::string sentence(std::string_view doc, const std::string& declared) {
  std::string out = escape(doc);
  std::vector<std::string> names = words_of(declared.substr(declared.find('(')));
  std::string first = out.substr(0, out.find_first_of(" ,"));
  bool name = std::find(names.begin(), names.end(), first) != names.end() || first.size() < 2;
  if (!name) out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  return out + ".";
}

std::string token_table(std::string_view set) {
  std::string out = "| optional argument | value | |\n|---|---|---|\n";
  for (const TokenInfo& t : tokens())
    if (t.set == set)
      out += fmt::format("| `\"{}\"` | {}{}{} | {} |\n", t.name, t.output ? "output " : "",
                         t.uniform ? "uniform " : "", t.any ? "any type" : type_name(t.type), escape(t.doc));
  return out + '\n';
}

std::string function_entry(std::string_view name) {
  std::string out = fmt::format("### {}\n\n", name);
  std::map<std::string_view, std::vector<std::string>> by_doc;
  std::vector<std::string_view> order;
  std::set<std::string_view> token_sets;
  std::vector<std::string> pending; // declarations of what only compiles
  size_t rows = 0;
  uint32_t flags = 0;
  double most = -1; // greatest error
  for (ShadeopId id : shadeop_overloads(name)) {
    const ShadeopInfo& row = shadeop(id);
    if (row.flags & kInternal) continue;
    if (!by_doc.contains(row.doc)) order.push_back(row.doc);
    by_doc[row.doc].push_back(declaration(row));
    if (!row.signature.token_set.empty()) token_sets.insert(row.signature.token_set);
    ++rows;
    if (row.kind == ShadeopKind::kPending) pending.push_back(declaration(row));
    flags |= row.flags;
    most = std::max(most, row.ulps);
  }
  for (std::string_view doc : order)
    out += fmt::format("{}\n{}\n", declarations(by_doc[doc]), paragraph(sentence(doc, by_doc[doc].front())));
  if (most > 0)
    out += fmt::format("Accurate to {:g} ulp.\n\n", most);
  else if (most == 0)
    out += "Exact.\n\n";
  if (flags & kInIlluminance) out += "Only inside an illuminance loop.\n\n";
  if (flags & kSurfaceOnly) out += "Not in light shaders.\n\n";
  if (flags & kDerivative) out += "Looks at neighbouring points of the grid.\n\n";
  if (!pending.empty() && pending.size() < rows)
    out += fmt::format(
        "This form compiles, but this version cannot carry it out: in pictures it gives 0, with a warning; "
        "elsewhere binding a shader that calls it is an error:\n\n{}\n",
        declarations(pending));
  else if (!pending.empty())
    out += "*Compiles, but this version cannot carry it out: in pictures it gives 0, with a warning; "
           "elsewhere binding a "
           "shader that calls it is an error.*\n\n";
  for (std::string_view set : token_sets)
    out += token_table(set);
  return out;
}

std::string variables_section() {
  std::string out = "## Variables\n\n"
                    "For each kind of shader: r readable, w writable, - not visible.\n\n"
                    "| variable | type | surface | displacement | light | volume | imager | "
                    "|\n|---|---|---|---|---|---|---|---|\n";
  for (int i = 0; i < kGlobalCount; ++i) {
    const GlobalInfo& g = global_info(static_cast<Global>(i));
    out += fmt::format("| `{}` | {}{} |", g.name, g.detail == Detail::kVarying ? "varying " : "uniform ",
                       type_name(g.type));
    for (char access : g.access)
      out += fmt::format(" {} |", access);
    out += fmt::format(" {} |\n", escape(g.doc));
  }
  return out + "\n`PI` is 3.14159265 in all of them.\n\n";
}

// How a heading is called in links.
std::string anchor(std::string_view title) {
  std::string out;
  for (char c : title)
    out += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string link(std::string_view title) {
  return fmt::format("[{}](#{})", title, anchor(title));
}

} // namespace

std::string shadeops_page() {
  std::string out = std::string("# Built-in functions and variables\n\n") + kGenerated;
  out += paragraph("A function with several declarations is chosen by its arguments and by the type that is "
                   "wanted. Where a "
                   "declaration says `type`, it stands for several that differ in that type only. `uniform` "
                   "parameters need a "
                   "value that is the same at all points; `output` and `inout` ones a variable, which is "
                   "set; `any` is a value "
                   "of any type. `...` stands for any number of arguments of that kind, or for the optional "
                   "arguments in the "
                   "table below: a name and a value each. `[channel]` may be left out.") +
         "\n";
  out +=
      paragraph("Accuracy is given for the worst form of a function, in units in the last place (ulp) of "
                "the result or, where "
                "terms cancel, of the terms. Tests hold every function to it, for every instruction set.") +
      "\n";
  std::vector<Section> all = sections();
  out += "| section | functions |\n|---|---|\n| [Variables](#variables) | |\n";
  for (const Section& section : all) {
    std::string names;
    for (const std::string& name : section.functions)
      names += (names.empty() ? "" : " ") + link(name);
    out += fmt::format("| {} | {} |\n", link(section.title), names);
  }
  out += "\n" + variables_section();
  for (const Section& section : all) {
    out += fmt::format("## {}\n\n", section.title);
    for (const std::string& name : section.functions)
      out += function_entry(name);
  }
  out.pop_back();
  return out;
}

} // namespace docs

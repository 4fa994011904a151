#include "slvm/tools/sltest/expression.h"

#include "slvm/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace slvm::sltest {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// The file that is the wrapper; nothing in it is of interest to users.
constexpr const char* kWrapperName = "<expression>";

constexpr Type kResultTypes[] = {Type::kFloat,  Type::kColor,  Type::kPoint, Type::kVector,
                                 Type::kNormal, Type::kMatrix, Type::kString};

std::string formal_text(const Formal& f) {
  const bool text = f.type == Type::kString;
  std::string array = f.elements ? fmt::format("[{}]", f.elements) : "";
  return fmt::format("{} {} {}{} = {};", f.varying ? "varying" : "uniform", type_name(f.type), f.name, array,
                     text ? "\"\"" : "0");
}

/// The shader around the code, which stands on a line of its own, at the column where it stands in its file.
std::string shader_text(const std::string& code, std::span<const Formal> formals, Type type, bool has_result,
                        const CodeOptions& options) {
  const bool text = type == Type::kString;
  std::string source = options.prelude.empty() ? "" : options.prelude + "\n";
  source += fmt::format("surface {}(", kExpressionName);
  for (const Formal& f : formals)
    source += formal_text(f);
  if (has_result)
    source += fmt::format("output {} {} {} = {};", text ? "uniform" : "varying", type_name(type),
                          options.result, text ? "\"\"" : "0");
  source += ")\n{\n" + options.macros;
  if (has_result && !is_statements(code)) source += options.result + " =\n";
  source += fmt::format("#line {} \"{}\"\n", options.first_line, options.label);
  if (code.find('\n') == std::string::npos) source.append(options.first_column - 1, ' ');
  return source + code + (code.find("//") == std::string::npos ? ";\n}\n" : "\n;\n}\n");
}

size_t count_errors(const std::string& text) {
  size_t count = 0;
  for (size_t at = text.find("error: "); at != std::string::npos; at = text.find("error: ", at + 1))
    ++count;
  return count;
}

} // namespace

bool is_statements(std::string_view code) {
  bool in_text = false;
  for (size_t i = 0; i < code.size(); ++i) {
    if (code[i] == '\\' && in_text)
      ++i;
    else if (code[i] == '"')
      in_text = !in_text;
    else if (!in_text && (code[i] == ';' || code[i] == '{'))
      return true;
  }
  return false;
}

bool mentions(std::string_view code, std::string_view word) {
  for (size_t at = code.find(word); at != std::string_view::npos; at = code.find(word, at + 1)) {
    const size_t end = at + word.size();
    if ((at == 0 || !is_word(code[at - 1])) && (end == code.size() || !is_word(code[end]))) return true;
  }
  return false;
}

ShaderPtr compile_code(ShaderLibrary& library, const std::string& code, std::span<const Formal> formals,
                       const CodeOptions& options, ShaderError& error) {
  const bool has_result = !is_statements(code) || mentions(code, options.result);
  std::span<const Type> types = kResultTypes;
  if (!options.types.empty()) types = options.types;
  if (!has_result) types = types.first(1);

  size_t fewest = 0;
  auto attempt = [&](Type type, bool assigned) {
    ShaderError failure;
    ShaderPtr shader = library.compile(kWrapperName, shader_text(code, formals, type, assigned, options),
                                       options.mode, options.path, failure);
    const size_t errors = count_errors(failure.text); // the attempt nearest to success explains best
    if (!shader && (error.text.empty() || errors < fewest)) {
      error = failure;
      fewest = errors;
    }
    return shader;
  };
  for (Type type : types)
    if (ShaderPtr shader = attempt(type, has_result)) return shader;
  return has_result && !is_statements(code) && options.types.empty() ? attempt(Type::kFloat, false) : nullptr;
}

std::vector<Formal> primvar_formals(const GridData& grid) {
  std::vector<Formal> formals;
  for (const Variable& v : grid.variables)
    if (find_global(v.name) == Global::kCount) formals.push_back({v.name, v.type, v.elements, v.varying});
  return formals;
}

Result<Variable> evaluate_code(ShaderLibrary& library, const std::string& code, const GridData& grid,
                               const Scene& scene, const CodeOptions& options) {
  ShaderError error;
  ShaderPtr compiled = compile_code(library, code, primvar_formals(grid), options, error);
  if (!compiled) return Error{error.text};

  Machine machine;
  auto shader = machine.load(compiled->slo);
  if (!shader) return Error{shader.error()};
  InstanceOptions instance_options;
  for (const Formal& f : primvar_formals(grid))
    instance_options.may_vary.push_back(f.name);
  auto instance = machine.instantiate(*shader, {}, instance_options);
  if (!instance) return Error{instance.error()};

  Grid work(grid.nu, grid.nv);
  fill(work, grid, machine.strings());
  MemoryServices services(scene, {});
  ShadingContext context(machine, services);
  context.shade({.surface = instance->get()}, work);
  const Planes* planes = context.output(**instance, options.result);
  if (!planes || !planes->data) return Error{"the code sets no result"};
  return read(options.result, *planes, grid.points(), machine.strings());
}

} // namespace slvm::sltest

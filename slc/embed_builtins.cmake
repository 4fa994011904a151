# Writes OUTPUT, a C++ file that holds the text of each of FILES: cmake -DOUTPUT=... -DFILES=a|b -P embed_builtins.cmake
string(REPLACE "|" ";" FILES "${FILES}")
set(rows "")
foreach(path IN LISTS FILES)
  file(READ "${path}" text)
  get_filename_component(name "${path}" NAME)
  string(APPEND rows "    {\"builtins/${name}\", R\"RSL(${text})RSL\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Generated from stdlib/builtins.\n#include \"slc/sema/builtins.h\"\n\n#include <vector>\n
namespace slc {\n
std::span<const BuiltinSource> builtin_sources() {
  static const std::vector<BuiltinSource> kSources = {\n${rows}  };
  return kSources;\n}\n\n} // namespace slc\n")

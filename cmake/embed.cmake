# Writes OUTPUT, a C++ file with the function NAMESPACE::FUNCTION of HEADER, which gives the texts of FILES, each named
# PREFIX and its file name. Run by sl_embed().
string(REPLACE "|" ";" FILES "${FILES}")
set(rows "")
foreach(path IN LISTS FILES)
  file(READ "${path}" text)
  get_filename_component(name "${path}" NAME)
  string(APPEND rows "    {\"${PREFIX}${name}\", R\"RSL(${text})RSL\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Generated.\n#include \"${HEADER}\"\n\n#include <vector>\n
namespace ${NAMESPACE} {\n
std::span<const EmbeddedText> ${FUNCTION}() {
  static const std::vector<EmbeddedText> kTexts = {\n${rows}  };
  return kTexts;\n}\n\n} // namespace ${NAMESPACE}\n")

// Types of tokens: what "Declare", inline declarations and the predeclared list say of the name in a
// token-value pair.
#pragma once

#include "render/rib/request.h"
#include "slvm/format/types.h"
#include "slvm/support/result.h"
#include "slvm/value.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace render {

enum class StorageClass : uint8_t { kConstant, kUniform, kVarying, kVertex, kFaceVarying };
std::string_view storage_class_name(StorageClass);

struct Declaration {
  std::string name;
  StorageClass storage = StorageClass::kUniform;
  slvm::Type type = slvm::Type::kFloat;
  uint32_t elements = 0; ///< array length; 0: not an array
  bool integer = false;  ///< written as integer; a float to shaders
  bool hpoint = false;   ///< four numbers each in the file, divided by the fourth
  bool mpoint = false;   ///< a matrix each: where a leaf of a Blobby is in another pose; a point to shaders

  /// Numbers (or strings) of one value in the file.
  int width() const {
    const int numbers = mpoint ? 16 : hpoint ? 4 : slvm::components(type);
    return numbers * static_cast<int>(elements ? elements : 1);
  }
};

/// The dictionary. Global and unscoped, as the RISpec has it.
class Declarations {
public:
  Declarations(); ///< holds the predeclared names
  /// "[class] [type] [[n]]" for a name. The error says what is wrong with the text.
  slvm::Result<Declaration> declare(std::string_view name, std::string_view text);
  /// A token as it stands in a parameter list: inline declaration or declared name. The error names the
  /// nearest declared name.
  slvm::Result<Declaration> resolve(std::string_view token) const;
  /// A declared name, or nullptr.
  const Declaration* find(std::string_view name) const;

private:
  std::map<std::string, Declaration, std::less<>> names_;
};

/// A token-value pair with its type.
struct TypedParam {
  Declaration declaration;
  std::vector<float> numbers;
  std::vector<std::string> strings;
  slvm::SourceRange where;
};

/// The value of an option or attribute: declared type if the token has one, else float or string by what was
/// written. hpoints lose their fourth number. The error is that of an ill-formed inline declaration or a
/// wrong count.
slvm::Result<std::pair<std::string, slvm::Value>> loose_value(const Param&, const Declarations&);

} // namespace render

// What is to be run: a shader, its parameters, the grid, the lights and all else it may ask about. The
// one-off form of the command line and the cases of a test file both are a Setup. Plain data, read in this
// order: value.h (values whose type is not known yet), setup.h, test_case.h (what a test expects of it).
#pragma once

#include "slvm/grid.h"
#include "slvm/support/matrix.h"
#include "slvm/tools/sltest/value.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace slvm::sltest {

enum class ShaderForm : uint8_t { kNone, kFile, kSource, kExpression };

/// A shader and what it is given.
struct ShaderRef {
  ShaderForm form = ShaderForm::kNone;
  std::string text;            ///< name or path, RSL source, or RSL expression or statements
  std::vector<Setting> params; ///< a later setting of one name replaces an earlier one
  Matrix4 space;               ///< "shader" to "current"
  std::optional<Type> result;  ///< of an expression, where it is known beforehand
  Where where;
};

struct GridSpec {
  std::string shape = "plane";
  int nu = 1, nv = 1;
  bool center = false; ///< sample at the centres of nu x nv cells instead of from edge to edge
  bool derivatives = true;
  bool flip_normals = false;
  RayFacts ray;
};

struct Setup {
  ShaderRef shader; ///< the shader under test
  std::map<std::string, ShaderRef>
      companions; ///< "surface", "displacement", "atmosphere", "interior", "exterior"
  std::vector<ShaderRef> lights;
  GridSpec grid;
  std::vector<Setting> variables;        ///< predefined variables, in the order they are set
  std::vector<Setting> primvars;         ///< primitive variables, likewise
  std::map<std::string, Matrix4> spaces; ///< from the named space to "current"
  std::vector<Setting> attributes, options;
  std::string scene; ///< RIB of what rays hit; "": nothing
  Where scene_where;
  std::string prelude;           ///< RSL before each expression: #include lines, macros, functions
  std::vector<std::string> path; ///< folders searched for shaders and for what they include, in order
};

} // namespace slvm::sltest

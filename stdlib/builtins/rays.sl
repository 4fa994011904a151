/* Built-in functions written in the language: short forms of rayinfo(). How these bodies are found: mathematics.sl. */

uniform float raydepth() {
  uniform float depth = 0;
  rayinfo("depth", depth);
  return depth;
}
uniform float raylevel() {
  return raydepth();
}
uniform string raylabel() {
  uniform string label = "";
  rayinfo("label", label);
  return label;
}
uniform float isshadowray() {
  uniform string type = "";
  rayinfo("type", type);
  uniform float result = 0;
  if (type == "transmission") result = 1;
  return result;
}
uniform float isindirectray() {
  uniform string type = "";
  rayinfo("type", type);
  uniform float result = 0;
  if (type == "diffuse") result = 1;
  return result;
}

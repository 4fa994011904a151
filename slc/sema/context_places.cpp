// What may stand where: predefined variables by kind of shader, functions by the loop around them.
#include "slc/sema/context_walk.h"

namespace slc {

void ContextWalk::check_global(const Variable& v, bool store, SourceRange where) {
  char access = slvm::global_info(v.global).access[static_cast<size_t>(shader_.kind)];
  std::string_view kind = slvm::shader_kind_name(shader_.kind);
  bool light = shader_.kind == ShaderKind::kLight;
  bool of_lights = v.global == Global::kL || v.global == Global::kCl || v.global == Global::kOl;
  if (access == '-') {
    std::string_view advice;
    if (light && (v.global == Global::kCi || v.global == Global::kOi))
      advice = "; lights set Cl and Ol";
    else if (shader_.kind == ShaderKind::kDisplacement &&
             (v.global == Global::kCi || v.global == Global::kOi))
      advice = "; displacements set P and N";
    else if (of_lights && shader_.kind != ShaderKind::kSurface)
      advice = "; it belongs to lights and to light loops of surfaces";
    complain(Msg::kGlobalNotHere, where, v.name, kind, advice);
  } else if (store && access == 'r' && of_lights) {
    complain(Msg::kLightReadOnly, where, v.name, kind);
  } else if (store && access == 'r') {
    complain(Msg::kGlobalReadOnly, where, v.name, kind);
    shader_.copied.insert(v.global);
  } else if (of_lights && !light && illuminance_ == 0) {
    complain(Msg::kOutsideIlluminance, where, v.name);
  } else if (light && v.global == Global::kL && emission_ == 0) {
    complain(store ? Msg::kStrayLightVector : Msg::kOutsideEmission, where, v.name);
  }
}

void ContextWalk::check_row_place(const CallExpr& e, uint32_t flags) {
  if ((flags & slvm::kSurfaceOnly) && shader_.kind == ShaderKind::kLight)
    complain(Msg::kCallNotInLights, e.range, e.name);
  if ((flags & slvm::kInIlluminance) && illuminance_ == 0)
    complain(Msg::kOutsideIlluminance, e.range, e.name);
}

} // namespace slc

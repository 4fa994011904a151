// The tokens and bases of ri.h.
#include "render/ri/tokens.h"

#include <algorithm>

extern "C" {

RtInt RiLastError = RIE_NOERROR;

#define RI_TOKEN(name, text) RtToken name = text;
RI_TOKEN(RI_FRAMEBUFFER, "framebuffer")
RI_TOKEN(RI_FILE, "file")
RI_TOKEN(RI_RGB, "rgb")
RI_TOKEN(RI_RGBA, "rgba")
RI_TOKEN(RI_RGBZ, "rgbz")
RI_TOKEN(RI_RGBAZ, "rgbaz")
RI_TOKEN(RI_A, "a")
RI_TOKEN(RI_Z, "z")
RI_TOKEN(RI_AZ, "az")
RI_TOKEN(RI_MERGE, "merge")
RI_TOKEN(RI_ORIGIN, "origin")
RI_TOKEN(RI_PERSPECTIVE, "perspective")
RI_TOKEN(RI_ORTHOGRAPHIC, "orthographic")
RI_TOKEN(RI_HIDDEN, "hidden")
RI_TOKEN(RI_PAINT, "paint")
RI_TOKEN(RI_CONSTANT, "constant")
RI_TOKEN(RI_SMOOTH, "smooth")
RI_TOKEN(RI_FLATNESS, "flatness")
RI_TOKEN(RI_FOV, "fov")
RI_TOKEN(RI_AMBIENTLIGHT, "ambientlight")
RI_TOKEN(RI_POINTLIGHT, "pointlight")
RI_TOKEN(RI_DISTANTLIGHT, "distantlight")
RI_TOKEN(RI_SPOTLIGHT, "spotlight")
RI_TOKEN(RI_INTENSITY, "intensity")
RI_TOKEN(RI_LIGHTCOLOR, "lightcolor")
RI_TOKEN(RI_FROM, "from")
RI_TOKEN(RI_TO, "to")
RI_TOKEN(RI_CONEANGLE, "coneangle")
RI_TOKEN(RI_CONEDELTAANGLE, "conedeltaangle")
RI_TOKEN(RI_BEAMDISTRIBUTION, "beamdistribution")
RI_TOKEN(RI_MATTE, "matte")
RI_TOKEN(RI_METAL, "metal")
RI_TOKEN(RI_SHINYMETAL, "shinymetal")
RI_TOKEN(RI_PLASTIC, "plastic")
RI_TOKEN(RI_PAINTEDPLASTIC, "paintedplastic")
RI_TOKEN(RI_KA, "Ka")
RI_TOKEN(RI_KD, "Kd")
RI_TOKEN(RI_KS, "Ks")
RI_TOKEN(RI_KR, "Kr")
RI_TOKEN(RI_ROUGHNESS, "roughness")
RI_TOKEN(RI_TEXTURENAME, "texturename")
RI_TOKEN(RI_SPECULARCOLOR, "specularcolor")
RI_TOKEN(RI_DEPTHCUE, "depthcue")
RI_TOKEN(RI_FOG, "fog")
RI_TOKEN(RI_BUMPY, "bumpy")
RI_TOKEN(RI_MINDISTANCE, "mindistance")
RI_TOKEN(RI_MAXDISTANCE, "maxdistance")
RI_TOKEN(RI_DISTANCE, "distance")
RI_TOKEN(RI_BACKGROUND, "background")
RI_TOKEN(RI_AMPLITUDE, "amplitude")
RI_TOKEN(RI_INSIDE, "inside")
RI_TOKEN(RI_OUTSIDE, "outside")
RI_TOKEN(RI_LH, "lh")
RI_TOKEN(RI_RH, "rh")
RI_TOKEN(RI_P, "P")
RI_TOKEN(RI_PZ, "Pz")
RI_TOKEN(RI_PW, "Pw")
RI_TOKEN(RI_N, "N")
RI_TOKEN(RI_NP, "Np")
RI_TOKEN(RI_CS, "Cs")
RI_TOKEN(RI_OS, "Os")
RI_TOKEN(RI_S, "s")
RI_TOKEN(RI_T, "t")
RI_TOKEN(RI_ST, "st")
RI_TOKEN(RI_WIDTH, "width")
RI_TOKEN(RI_CONSTANTWIDTH, "constantwidth")
RI_TOKEN(RI_BILINEAR, "bilinear")
RI_TOKEN(RI_BICUBIC, "bicubic")
RI_TOKEN(RI_LINEAR, "linear")
RI_TOKEN(RI_CUBIC, "cubic")
RI_TOKEN(RI_PRIMITIVE, "primitive")
RI_TOKEN(RI_INTERSECTION, "intersection")
RI_TOKEN(RI_UNION, "union")
RI_TOKEN(RI_DIFFERENCE, "difference")
RI_TOKEN(RI_PERIODIC, "periodic")
RI_TOKEN(RI_NONPERIODIC, "nonperiodic")
RI_TOKEN(RI_CLAMP, "clamp")
RI_TOKEN(RI_BLACK, "black")
RI_TOKEN(RI_IGNORE, "ignore")
RI_TOKEN(RI_PRINT, "print")
RI_TOKEN(RI_ABORT, "abort")
RI_TOKEN(RI_HANDLER, "handler")
RI_TOKEN(RI_COMMENT, "comment")
RI_TOKEN(RI_STRUCTURE, "structure")
RI_TOKEN(RI_VERBATIM, "verbatim")
RI_TOKEN(RI_IDENTIFIER, "identifier")
RI_TOKEN(RI_NAME, "name")
RI_TOKEN(RI_SHADINGGROUP, "shadinggroup")
RI_TOKEN(RI_LIGHTSOURCE, "lightsource")
RI_TOKEN(RI_CATMULLCLARK, "catmull-clark")
RI_TOKEN(RI_HOLE, "hole")
RI_TOKEN(RI_CREASE, "crease")
RI_TOKEN(RI_CORNER, "corner")
RI_TOKEN(RI_INTERPOLATEBOUNDARY, "interpolateboundary")
RI_TOKEN(RI_RASTER, "raster")
RI_TOKEN(RI_SCREEN, "screen")
RI_TOKEN(RI_CAMERA, "camera")
RI_TOKEN(RI_WORLD, "world")
RI_TOKEN(RI_OBJECT, "object")
RI_TOKEN(RI_NDC, "NDC")
RI_TOKEN(RI_CURRENT, "current")
RI_TOKEN(RI_SHADER, "shader")
RI_TOKEN(RI_LIMITS, "limits")
RI_TOKEN(RI_BUCKETSIZE, "bucketsize")
RI_TOKEN(RI_GRIDSIZE, "gridsize")
RI_TOKEN(RI_SEARCHPATH, "searchpath")
RI_TOKEN(RI_TEXTURE, "texture")
RI_TOKEN(RI_ARCHIVE, "archive")
RI_TOKEN(RI_PROCEDURAL, "procedural")

// RISpec 3.2, section 5.3: rows hold the coefficients of t^3, t^2, t and 1.
RtBasis RiBezierBasis = {{-1, 3, -3, 1}, {3, -6, 3, 0}, {-3, 3, 0, 0}, {1, 0, 0, 0}};
RtBasis RiBSplineBasis = {{-1.0f / 6, 3.0f / 6, -3.0f / 6, 1.0f / 6},
                          {3.0f / 6, -6.0f / 6, 3.0f / 6, 0},
                          {-3.0f / 6, 0, 3.0f / 6, 0},
                          {1.0f / 6, 4.0f / 6, 1.0f / 6, 0}};
RtBasis RiCatmullRomBasis = {
    {-0.5f, 1.5f, -1.5f, 0.5f}, {1, -2.5f, 2, -0.5f}, {-0.5f, 0, 0.5f, 0}, {0, 1, 0, 0}};
RtBasis RiHermiteBasis = {{2, 1, -2, 1}, {-3, -2, 3, -1}, {0, 1, 0, 0}, {1, 0, 0, 0}};
RtBasis RiPowerBasis = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

} // extern "C"

namespace render::ri {

std::string_view basis_name(const RtFloat (*matrix)[4]) {
  const std::pair<const RtBasis&, std::string_view> kBases[] = {{RiBezierBasis, "bezier"},
                                                                {RiBSplineBasis, "b-spline"},
                                                                {RiCatmullRomBasis, "catmull-rom"},
                                                                {RiHermiteBasis, "hermite"},
                                                                {RiPowerBasis, "power"}};
  for (const auto& [basis, name] : kBases)
    if (std::equal(&basis[0][0], &basis[0][0] + 16, &matrix[0][0])) return name;
  return {};
}

} // namespace render::ri

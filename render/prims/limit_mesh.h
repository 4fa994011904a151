// What OpenSubdiv does for the renderer: limit surfaces over the faces of a mesh. In a module,
// anemone_subdivision.so, that is loaded for the first mesh: most scenes have none.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace render {

struct SubdivisionMesh;

/// How (u,v) runs over a face.
struct FaceDomain {
  enum class Kind : uint8_t {
    kQuad,     ///< the unit square
    kTriangle, ///< its half, u + v <= 1
    kSubFaces  ///< a square half a unit wide for each corner, `columns` of them in a row, a unit apart
  };
  Kind kind = Kind::kQuad;
  int columns = 1;
};

/// One variable (or P) over a face: `width` numbers and their derivatives.
class LimitSurface {
public:
  virtual ~LimitSurface() = default;
  virtual void at(const double (&uv)[2], double* value) const = 0;
  virtual void at(const double (&uv)[2], double* value, double* du, double* dv) const = 0;
  virtual void at(const double (&uv)[2], double* value, double* du, double* dv, double* duv) const = 0;

  const FaceDomain& domain() const { return domain_; }
  int width() const { return width_; }
  /// Of degree 3 in u and v, over a square.
  bool polynomial() const { return polynomial_; }
  bool linear() const { return linear_; }
  /// `width` numbers each; the surface lies within their hull.
  std::span<const double> control_points() const { return points_; }

protected:
  FaceDomain domain_;
  int width_ = 0;
  bool polynomial_ = false, linear_ = false;
  std::vector<double> points_;
};

/// Values that corners of faces have each for themselves.
struct CornerValues {
  int count = 0;
  std::span<const int> indices; ///< for each corner of each face
};

/// A mesh and the rules it is refined by.
class LimitMesh {
public:
  enum class Values : uint8_t { kVertex, kVarying, kFaceVarying };

  virtual ~LimitMesh() = default;
  /// `values` must live as long as the surface is being made; `channel`: of facevarying ones. Null: the face
  /// is a hole, or its surface has no limit.
  virtual std::shared_ptr<const LimitSurface> surface(int face, Values kind, std::span<const double> values,
                                                      int width, int channel) const = 0;
};

/// The function of the module; unset when there is a `problem`.
struct SubdivisionModule {
  std::string problem;
  /// Null: the faces do not make a mesh.
  std::unique_ptr<const LimitMesh> (*make)(const SubdivisionMesh& mesh, size_t points,
                                           std::span<const CornerValues> channels) = nullptr;
};

/// Loaded at the first call.
const SubdivisionModule& subdivision_module();

} // namespace render

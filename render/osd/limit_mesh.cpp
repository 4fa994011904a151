// The module anemone_subdivision.so, as render/prims/limit_mesh.h describes it. Nothing else of the renderer
// uses OpenSubdiv.
#include "render/prims/limit_mesh.h"

#include "render/prims/subdivision_mesh.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>

namespace render {

namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

using Surface = Bfr::Surface<double>;
using Factory = Bfr::RefinerSurfaceFactory<>;

FaceDomain domain_of(const Bfr::Parameterization& parameters) {
  if (parameters.GetType() == Bfr::Parameterization::TRI) return {FaceDomain::Kind::kTriangle, 1};
  if (!parameters.HasSubFaces()) return {};
  // The first sub-face that begins a row.
  FaceDomain out{FaceDomain::Kind::kSubFaces, 1};
  for (;; ++out.columns) {
    const double corner[2] = {0, 0};
    double at[2];
    parameters.ConvertNormalizedSubFaceToCoord(out.columns, corner, at);
    if (at[1] > 0) return out;
  }
}

class FaceSurface final : public LimitSurface {
public:
  FaceSurface(const Factory& factory, int face, LimitMesh::Values kind, int channel) {
    using Values = LimitMesh::Values;
    found_ = kind == Values::kVertex    ? factory.InitVertexSurface(face, &surface_)
             : kind == Values::kVarying ? factory.InitVaryingSurface(face, &surface_)
                                        : factory.InitFaceVaryingSurface(face, &surface_, channel);
  }
  bool found() const { return found_; }
  void fetch(std::span<const double> values, int width) {
    width_ = width;
    domain_ = domain_of(surface_.GetParameterization());
    linear_ = surface_.IsLinear();
    polynomial_ = surface_.IsRegular() && !linear_ && domain_.kind != FaceDomain::Kind::kTriangle;
    points_.resize(static_cast<size_t>(surface_.GetNumPatchPoints() * width));
    surface_.PreparePatchPoints(values.data(), layout(), points_.data(), layout());
  }

  void at(const double (&uv)[2], double* value) const override {
    surface_.Evaluate(uv, points_.data(), layout(), value);
  }
  void at(const double (&uv)[2], double* value, double* du, double* dv) const override {
    surface_.Evaluate(uv, points_.data(), layout(), value, du, dv);
  }
  void at(const double (&uv)[2], double* value, double* du, double* dv, double* duv) const override {
    std::vector<double> duu(static_cast<size_t>(width_)), dvv(static_cast<size_t>(width_));
    surface_.Evaluate(uv, points_.data(), layout(), value, du, dv, duu.data(), duv, dvv.data());
  }

private:
  Surface::PointDescriptor layout() const { return Surface::PointDescriptor(width_); }

  Surface surface_;
  bool found_;
};

using Refiner = std::unique_ptr<const Far::TopologyRefiner>;
using Topology = Far::TopologyDescriptor;

Sdc::Options options_of(const SubdivisionMesh& mesh) {
  Sdc::Options options;
  constexpr Sdc::Options::VtxBoundaryInterpolation kBoundary[] = {Sdc::Options::VTX_BOUNDARY_NONE,
                                                                  Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER,
                                                                  Sdc::Options::VTX_BOUNDARY_EDGE_ONLY};
  options.SetVtxBoundaryInterpolation(kBoundary[mesh.boundary]);
  const Sdc::Options::FVarLinearInterpolation kFaceVarying[] = {
      Sdc::Options::FVAR_LINEAR_ALL,
      mesh.propagate_corners ? Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2
                             : Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1,
      Sdc::Options::FVAR_LINEAR_NONE, Sdc::Options::FVAR_LINEAR_BOUNDARIES};
  options.SetFVarLinearInterpolation(kFaceVarying[mesh.facevarying_boundary]);
  if (mesh.chaikin) options.SetCreasingMethod(Sdc::Options::CREASE_CHAIKIN);
  if (mesh.smooth_triangles) options.SetTriangleSubdivision(Sdc::Options::TRI_SUB_SMOOTH);
  return options;
}

Refiner make_refiner(const SubdivisionMesh& mesh, size_t points, std::span<const CornerValues> values) {
  Topology t;
  t.numVertices = static_cast<int>(points);
  t.numFaces = static_cast<int>(mesh.nvertices.size());
  t.numVertsPerFace = mesh.nvertices.data();
  t.vertIndicesPerFace = mesh.vertices.data();
  t.numCreases = static_cast<int>(mesh.crease_sharpness.size());
  t.creaseVertexIndexPairs = mesh.crease_pairs.data();
  t.creaseWeights = mesh.crease_sharpness.data();
  t.numCorners = static_cast<int>(mesh.corners.size());
  t.cornerVertexIndices = mesh.corners.data();
  t.cornerWeights = mesh.corner_sharpness.data();
  t.numHoles = static_cast<int>(mesh.holes.size());
  t.holeIndices = mesh.holes.data();
  std::vector<Topology::FVarChannel> channels;
  for (const CornerValues& v : values) {
    Topology::FVarChannel& c = channels.emplace_back();
    c.numValues = v.count;
    c.valueIndices = v.indices.data();
  }
  t.numFVarChannels = static_cast<int>(channels.size());
  t.fvarChannels = channels.data();

  using TopologyFactory = Far::TopologyRefinerFactory<Topology>;
  TopologyFactory::Options create(mesh.loop       ? Sdc::SCHEME_LOOP
                                  : mesh.bilinear ? Sdc::SCHEME_BILINEAR
                                                  : Sdc::SCHEME_CATMARK,
                                  options_of(mesh));
  create.validateFullTopology = true;
  // What is wrong is said by the caller, not printed by the library.
  Far::SetErrorCallback([](Far::ErrorType, const char*) {});
  Far::SetWarningCallback([](const char*) {});
  return Refiner(TopologyFactory::Create(t, create));
}

class Mesh final : public LimitMesh {
public:
  explicit Mesh(Refiner refiner) : refiner_(std::move(refiner)), factory_(*refiner_) {}

  std::shared_ptr<const LimitSurface> surface(int face, Values kind, std::span<const double> values,
                                              int width, int channel) const override {
    auto out = std::make_shared<FaceSurface>(factory_, face, kind, channel);
    if (!out->found()) return nullptr;
    out->fetch(values, width);
    return out;
  }

private:
  Refiner refiner_;
  Factory factory_;
};

std::unique_ptr<const LimitMesh> make(const SubdivisionMesh& mesh, size_t points,
                                      std::span<const CornerValues> channels) {
  Refiner refiner = make_refiner(mesh, points, channels);
  if (!refiner) return nullptr;
  return std::make_unique<Mesh>(std::move(refiner));
}

} // namespace

} // namespace render

extern "C" void anemone_subdivision_module(render::SubdivisionModule* table) {
  *table = {"", render::make};
}

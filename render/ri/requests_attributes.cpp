// Ri functions: attributes, shaders, lights, transformations.
#include "render/ri/define.h"

using render::RiError;
using render::ri::Basis;
using render::ri::Context;
using render::ri::Floats;
using render::ri::Handle;
using render::ri::Ints;
using render::ri::ParameterList;
using render::ri::sum;

namespace {

/// The handle of the light, or null when there is none.
RtLightHandle light(Context* context, render::RequestId id, const ParameterList& list, RtToken name) {
  RtLightHandle handle = context->next_light();
  return context->send(id, list, name, Handle{handle}) ? handle : nullptr;
}

} // namespace

extern "C" {

RI_PARAMETERS(Attribute, (RtToken name), name, name)
RI_PLAIN(Color, (RtColor color), Floats{color, 3})
RI_PLAIN(Opacity, (RtColor opacity), Floats{opacity, 3})
RI_PLAIN(TextureCoordinates,
         (RtFloat s1, RtFloat t1, RtFloat s2, RtFloat t2, RtFloat s3, RtFloat t3, RtFloat s4, RtFloat t4), s1,
         t1, s2, t2, s3, t3, s4, t4)
RI_PAIR(RtLightHandle, LightSource, (RtToken name), name,
        light(context, render::RequestId::kLightSource, list, name))
RI_PAIR(RtLightHandle, AreaLightSource, (RtToken name), name,
        light(context, render::RequestId::kAreaLightSource, list, name))

RtVoid RiIlluminate(RtLightHandle light, RtBoolean on) {
  auto* context = render::ri::current("RiIlluminate");
  if (!context) return;
  if (context->is_light(light))
    context->send(render::RequestId::kIlluminate, {}, Handle{light}, RtInt{on});
  else
    context->error("RiIlluminate", RiError::kBadHandle, "this is not the handle of a light");
}

RI_PARAMETERS(Surface, (RtToken name), name, name)
RI_PARAMETERS(Displacement, (RtToken name), name, name)
RI_PARAMETERS(Atmosphere, (RtToken name), name, name)
RI_PARAMETERS(Interior, (RtToken name), name, name)
RI_PARAMETERS(Exterior, (RtToken name), name, name)
RI_PARAMETERS(Deformation, (RtToken name), name, name)
RI_PLAIN(ShadingRate, (RtFloat area), area)
RI_PLAIN(ShadingInterpolation, (RtToken type), type)
RI_PLAIN(Matte, (RtBoolean on), RtInt{on})
RI_PLAIN(Bound, (RtBound bound), Floats{bound, 6})
RI_PLAIN(Detail, (RtBound bound), Floats{bound, 6})
RI_PLAIN(DetailRange, (RtFloat offlow, RtFloat onlow, RtFloat onhigh, RtFloat offhigh), offlow, onlow, onhigh,
         offhigh)
RI_PLAIN(GeometricApproximation, (RtToken type, RtFloat value), type, value)
RI_PLAIN(Orientation, (RtToken orientation), orientation)
RI_PLAIN(ReverseOrientation, (void))
RI_PLAIN(Sides, (RtInt sides), sides)
RI_PLAIN(Basis, (RtBasis ubasis, RtInt ustep, RtBasis vbasis, RtInt vstep), Basis{ubasis}, ustep,
         Basis{vbasis}, vstep)
RI_PLAIN(TrimCurve,
         (RtInt nloops, RtInt ncurves[], RtInt order[], RtFloat knot[], RtFloat min[], RtFloat max[],
          RtInt n[], RtFloat u[], RtFloat v[], RtFloat w[]),
         Ints{ncurves, nloops}, Ints{order, sum(ncurves, nloops)},
         Floats{knot, sum(n, sum(ncurves, nloops)) + sum(order, sum(ncurves, nloops))},
         Floats{min, sum(ncurves, nloops)}, Floats{max, sum(ncurves, nloops)}, Ints{n, sum(ncurves, nloops)},
         Floats{u, sum(n, sum(ncurves, nloops))}, Floats{v, sum(n, sum(ncurves, nloops))},
         Floats{w, sum(n, sum(ncurves, nloops))})

RI_PLAIN(Identity, (void))
RI_PLAIN(Transform, (RtMatrix matrix), Floats{matrix ? matrix[0] : nullptr, 16})
RI_PLAIN(ConcatTransform, (RtMatrix matrix), Floats{matrix ? matrix[0] : nullptr, 16})
RI_PLAIN(Perspective, (RtFloat fov), fov)
RI_PLAIN(Translate, (RtFloat dx, RtFloat dy, RtFloat dz), dx, dy, dz)
RI_PLAIN(Rotate, (RtFloat angle, RtFloat dx, RtFloat dy, RtFloat dz), angle, dx, dy, dz)
RI_PLAIN(Scale, (RtFloat sx, RtFloat sy, RtFloat sz), sx, sy, sz)
RI_PLAIN(Skew, (RtFloat angle, RtFloat dx1, RtFloat dy1, RtFloat dz1, RtFloat dx2, RtFloat dy2, RtFloat dz2),
         angle, dx1, dy1, dz1, dx2, dy2, dz2)
RI_PLAIN(CoordinateSystem, (RtToken name), name)
RI_PLAIN(ScopedCoordinateSystem, (RtToken name), name)
RI_PLAIN(CoordSysTransform, (RtToken name), name)

RtPoint* RiTransformPoints(RtToken fromspace, RtToken tospace, RtInt n, RtPoint points[]) {
  auto* context = render::ri::current("RiTransformPoints");
  return context && context->transform_points(fromspace, tospace, n, points) ? points : nullptr;
}

} // extern "C"

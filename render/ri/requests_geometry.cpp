// Ri functions: geometry.
#include "render/ri/define.h"

#include <cstdlib>

using render::ri::Floats;
using render::ri::Ints;
using render::ri::Point;
using render::ri::sum;
using render::ri::Texts;
using render::ri::Vertices;

extern "C" {

RI_PARAMETERS(Sphere, (RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax), thetamax, radius, zmin,
              zmax, thetamax)
RI_PARAMETERS(Cone, (RtFloat height, RtFloat radius, RtFloat thetamax), thetamax, height, radius, thetamax)
RI_PARAMETERS(Cylinder, (RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax), thetamax, radius,
              zmin, zmax, thetamax)
RI_PARAMETERS(Hyperboloid, (RtPoint point1, RtPoint point2, RtFloat thetamax), thetamax, Point{point1},
              Point{point2}, thetamax)
RI_PARAMETERS(Paraboloid, (RtFloat rmax, RtFloat zmin, RtFloat zmax, RtFloat thetamax), thetamax, rmax, zmin,
              zmax, thetamax)
RI_PARAMETERS(Disk, (RtFloat height, RtFloat radius, RtFloat thetamax), thetamax, height, radius, thetamax)
RI_PARAMETERS(Torus,
              (RtFloat majorradius, RtFloat minorradius, RtFloat phimin, RtFloat phimax, RtFloat thetamax),
              thetamax, majorradius, minorradius, phimin, phimax, thetamax)

RI_PARAMETERS(Polygon, (RtInt nvertices), nvertices, Vertices{nvertices})
RI_PARAMETERS(GeneralPolygon, (RtInt nloops, RtInt nvertices[]), nvertices, Ints{nvertices, nloops})
RI_PARAMETERS(PointsPolygons, (RtInt npolys, RtInt nvertices[], RtInt vertices[]), vertices,
              Ints{nvertices, npolys}, Ints{vertices, sum(nvertices, npolys)})
RI_PARAMETERS(PointsGeneralPolygons, (RtInt npolys, RtInt nloops[], RtInt nvertices[], RtInt vertices[]),
              vertices, Ints{nloops, npolys}, Ints{nvertices, sum(nloops, npolys)},
              Ints{vertices, sum(nvertices, sum(nloops, npolys))})

RI_PARAMETERS(Patch, (RtToken type), type, type)
RI_PARAMETERS(PatchMesh, (RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap), vwrap, type, nu,
              uwrap, nv, vwrap)
RI_PARAMETERS(NuPatch,
              (RtInt nu, RtInt uorder, RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv, RtInt vorder,
               RtFloat vknot[], RtFloat vmin, RtFloat vmax),
              vmax, nu, uorder, Floats{uknot, nu + uorder}, umin, umax, nv, vorder,
              Floats{vknot, nv + vorder}, vmin, vmax)

RI_PARAMETERS(SubdivisionMesh,
              (RtToken scheme, RtInt nfaces, RtInt nvertices[], RtInt vertices[], RtInt ntags, RtToken tags[],
               RtInt nargs[], RtInt intargs[], RtFloat floatargs[]),
              floatargs, scheme, Ints{nvertices, nfaces}, Ints{vertices, sum(nvertices, nfaces)},
              Texts{tags, ntags}, Ints{nargs, 2 * ntags},
              Ints{intargs, render::ri::sum_of_every_second(nargs, ntags, 0)},
              Floats{floatargs, render::ri::sum_of_every_second(nargs, ntags, 1)})

RI_PARAMETERS(Points, (RtInt npoints), npoints, Vertices{npoints})
RI_PARAMETERS(Curves, (RtToken type, RtInt ncurves, RtInt nvertices[], RtToken wrap), wrap, type,
              Ints{nvertices, ncurves}, wrap)
RI_PARAMETERS(Blobby,
              (RtInt nleaf, RtInt ncode, RtInt code[], RtInt nfloats, RtFloat floats[], RtInt nstrings,
               RtString strings[]),
              strings, nleaf, Ints{code, ncode}, Floats{floats, nfloats}, Texts{strings, nstrings})
RI_PARAMETERS(Geometry, (RtToken type), type, type)

RtVoid RiProcedural(RtPointer data, RtBound bound, RtProcSubdivFunc subdivfunc, RtProcFreeFunc freefunc) {
  if (auto* context = render::ri::current("RiProcedural"))
    context->procedural(data, bound, subdivfunc, freefunc);
}

// They are known by their addresses. A program's own function may call one to hand on.
static RtVoid hand_on(RtPointer data, RtProcSubdivFunc function) {
  RtBound everywhere = {-RI_INFINITY, RI_INFINITY, -RI_INFINITY, RI_INFINITY, -RI_INFINITY, RI_INFINITY};
  RiProcedural(data, everywhere, function, nullptr);
}
RtVoid RiProcDelayedReadArchive(RtPointer data, RtFloat) {
  hand_on(data, RiProcDelayedReadArchive);
}
RtVoid RiProcRunProgram(RtPointer data, RtFloat) {
  hand_on(data, RiProcRunProgram);
}
RtVoid RiProcDynamicLoad(RtPointer data, RtFloat) {
  hand_on(data, RiProcDynamicLoad);
}
RtVoid RiProcFree(RtPointer data) {
  std::free(data);
}

} // extern "C"

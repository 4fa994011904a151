// The seven quadrics. All are surfaces of revolution about z: a profile q(v) in the xz plane (a line in space
// for the hyperboloid) turned by u * thetamax. Parameters and parameterisation: RISpec 3.2, section 5.2;
// angles in degrees.
#pragma once

#include "render/prims/geometry.h"
#include "slvm/support/result.h"

#include <memory>

namespace render {

using GeometryResult = slvm::Result<std::shared_ptr<const Geometry>>;

/// The error of each says why there is no surface, e.g. "the radius is zero".
GeometryResult make_sphere(float radius, float zmin, float zmax, float thetamax);
GeometryResult make_cone(float height, float radius, float thetamax);
GeometryResult make_cylinder(float radius, float zmin, float zmax, float thetamax);
GeometryResult make_hyperboloid(Vec3 point1, Vec3 point2, float thetamax);
GeometryResult make_paraboloid(float rmax, float zmin, float zmax, float thetamax);
GeometryResult make_disk(float height, float radius, float thetamax);
GeometryResult make_torus(float major, float minor, float phimin, float phimax, float thetamax);

} // namespace render

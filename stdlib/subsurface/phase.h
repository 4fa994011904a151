// The phase function of Henyey and Greenstein ("Diffuse radiation in the galaxy", 1941): how a scattering
// event changes the direction of light.
#pragma once

#include "stdlib/subsurface/vec3.h"

namespace subsurface {

/// p(cosine), normalised over the sphere [1/sr]; its mean cosine is g. `cosine`: between the directions in
/// which the light travels before and after. (1 - g^2)/(4 pi (1 + g^2 - 2 g cosine)^1.5). The course's 4.1.1
/// leaves out the 1/(4 pi), and its + sign belongs to its own convention, where one of the directions is
/// turned round.
double henyey_greenstein(double cosine, double g);
/// The cosine with the distribution of henyey_greenstein(), for uniform xi in [0, 1).
double sample_henyey_greenstein(double xi, double g);
/// `direction` (unit) turned by that cosine, by an angle 2 pi xi_around about itself.
Vec3 scatter_direction(Vec3 direction, double xi, double xi_around, double g);

} // namespace subsurface

// Tables of places for the diffusion term, for shaders that have no table of their own to make (appendix A of
// the course's chapter 4, mktables.c): points evenly on a disc, pulled to the distribution 1 - exp(-u)(1 +
// u).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace subsurface {

struct SampleTableOptions {
  int samples = 128;
  int tables = 1;
  int candidates = 10; ///< point i is the best of this many times i
  uint64_t seed = 0;
};

/// One table after another: multiplied by the diffuse mean free path they are offsets in the tangent plane.
struct SampleTables {
  std::vector<float> x, y;
};

/// Best candidates by D. P. Mitchell, "Spectrally Optimal Sampling for Distribution Ray Tracing", 1991,
/// warped. The course's program warps by R where R^2 is what is uniform, and its points crowd at the rim of
/// the disc: its mean radius is 3.26 instead of 2. Here the k-th nearest point of n gets the radius below
/// which (k + 1/2)/n of the distribution lie.
SampleTables make_sample_tables(const SampleTableOptions& options);

/// As RSL, in the course's layout: `uniform float scattdiffdist1[128] = {...};`, and scattdiffdist2 for y.
std::string format_sample_tables(const SampleTables& tables, const SampleTableOptions& options);

} // namespace subsurface

/* coraldisplacement.sl: polyps and roughness of a coral; the geometric half of coral.sl, which reads its outputs by message passing.
 *
 * A length of 0 (polyplength, boneroughness) switches the whole of its part off: nothing of its patterns runs. The bound of displacement
 * is polyplength + boneroughness, in shader space.
 */
#include "coral.h"

displacement
coraldisplacement(uniform float id = 0;           /* number of the model, for variation; 0: none */
                  uniform float size = 1;         /* of pattern features, shader space */
                  uniform float sizevariation = 0.3; /* how much size differs between models: by up to half of this part of it */
                  /* Where layers are, along the model. */
                  varying float tipdistance = 1;  /* scalar fields, primitive variables */
                  varying float basedistance = 1; /* 0 at the tips and at the base, 1 farthest from them */
                  uniform float boneextent = 0;   /* bare bone up to this basedistance; 0: none */
                  uniform float boneedge = 0.25;  /* how much patterns move that edge */
                  uniform float polypfrom = 0.05; /* polyps between these tipdistances */
                  uniform float polypto = 1;      /* 0 to 1; above 1: to the base */
                  uniform float polypfade = 0.15; /* width in which they grow smaller there */
                  /* Polyps: a pattern of organicpatterns.h, processed. */
                  uniform float polyppattern = 8; /* its number, 0 to 35 */
                  uniform string polypmap = "";   /* one channel, for patterns 32 to 35 */
                  uniform float polyplength = 0;  /* shader space; 0: flat */
                  uniform float polyplow = 0.25, polyphigh = 1, polypgain = 1; /* what of it counts; below 1 sharpens, above fattens */
                  /* Bone. */
                  uniform float bonepattern = 24;  /* its number, 0 to 31 */
                  uniform float boneroughness = 0; /* shader space; 0: smooth */
                  output varying float normaldot = 0;  /* facing of the surface before displacement */
                  output varying float polyp = 0;      /* height of polyps, 0 to 1 */
                  output varying float bone = 0;       /* 1 on bare bone */
                  output varying float noisevalue = -1; /* noise of the model, made once for all uses; -1: not made */
                  output varying point undisplaced = 0; /* P before displacement */
                  )
{
  normal Nn = normalize(N);
  point Pq = variedspace(transform("shader", P), modelvariation(id), size, sizevariation);
  float width = filterwidthp(Pq);
  float height = 0;

  undisplaced = P;
  normaldot = facing(Nn, I);
  if (boneextent > 0) {
    noisevalue = as_pattern(filteredsnoise(Pq, width));
    bone = 1 - patternramp(boneextent, boneextent + boneedge, basedistance, noisevalue, 0.1);
  }

  if (polyplength > 0) {
    float ss, tt;
    cubicprojection(Pq, ntransform("shader", Nn), ss, tt);
    float suppress = coverage(polypfrom, polypto, polypfade, tipdistance) * (1 - bone);
    if (suppress > 0)
      polyp = polypheight(organicpattern(polyppattern, Pq, width, polypmap, ss, tt), polyplow, polyphigh, polypgain, suppress);
    height += polyplength * polyp;
  }
  if (boneroughness > 0 && boneextent > 0)
    height += boneroughness * bone * organicpattern(bonepattern, 2 * Pq, 2 * width, "", 0, 0);

  if (polyplength > 0 || (boneroughness > 0 && boneextent > 0)) {
    P += height * Nn / length(vtransform("shader", Nn));
    N = calculatenormal(P);
  }
}

/* tankglass.sl: one wall of a fish tank, by pictures of what it mirrors and of what is seen through it.
 *
 * Both pictures are made before, without this wall, from cameras that `paneplan` works out from the plane of the wall, or from others that
 * look better. The file of a picture says where its camera was. What they show has its light already: it is added after the
 * illumination of the glass.
 */
#include "projectedpicture.h"

surface
tankglass(uniform string reflection = ""; /* picture of the reflection camera; "" for none */
          uniform string refraction = ""; /* and of the refraction camera */
          uniform float eta = 1.33;       /* refractive index of what is behind the glass: water */
          uniform float Kreflect = 1;     /* strength of mirroring: 1 as physics says */
          uniform float Krefract = 1;     /* strength of what is seen through */
          uniform color tint = color (0.92, 1, 0.97); /* of what is seen through the glass */
          /* Artistic offsets and blurs, as parts of the pictures. */
          uniform float reflectoffset[2] = {0, 0}, refractoffset[2] = {0, 0}; /* to the right and down */
          uniform float reflectblur = 0, refractblur = 0;                     /* 0 to 1 */
          /* Uneven glass: how far noise moves the pictures, and how fine it is, shader space. */
          uniform float warp = 0, warpsize = 1;                               /* a part of the pictures; the size of its bumps */
          uniform float Ka = 0, Kd = 0, Ks = 0.6, roughness = 0.05;           /* of the glass itself: parts of light, highlight width */
          )
{
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  float reflected, refracted;
  paneweights(I, Nf, eta, Kreflect, reflected, refracted);

  float swarp = 0, twarp = 0;
  if (warp > 0) {
    point q = transform("shader", P) / warpsize;
    swarp = warp * (float noise(q) - 0.5);
    twarp = warp * (float noise(q + vector (11.3, 7.1, 3.9)) - 0.5);
  }
  color glass = Cs * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, V, roughness);
  color mirrored = projectedpicture(reflection, P, reflectoffset[0] + swarp, reflectoffset[1] + twarp, reflectblur);
  color through = projectedpicture(refraction, P, refractoffset[0] + swarp, refractoffset[1] + twarp, refractblur);
  if (refraction != "") {
    Oi = Os;
    Ci = Os * (glass + reflected * mirrored + Krefract * refracted * tint * through);
  } else {
    /* Without a picture of what is behind, it is seen straight through. */
    Oi = Os * (1 - refracted * tint);
    Ci = Os * (glass + reflected * mirrored);
  }
}

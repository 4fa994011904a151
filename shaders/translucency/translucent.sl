/* translucent.sl: a sheet or solid, frosted in blobs through which things are seen blurred, clear colour between them. By rays, or in three passes
 * without any.
 *
 * phase says what is made:
 *   "trace"   the picture, in one pass: rays through the surface. Nothing else is needed.
 *   "mask"    the depth mask: opaque where it is translucent. Render this object alone, Hider "hidden" "subpixel" 1, a z Display.
 *   "behind"  what is behind, with Hider "depthmask" on that mask (dilated, see sldilate): here it shows what is not translucent.
 *   "beauty"  the picture, with that of "behind" as background.
 */
#include "translucency.h"

surface
translucent(uniform string phase = "trace"; /* see above */
            /* Blobs, in x and y of shader space. */
            uniform float period = 4;   /* blobs a unit */
            uniform float noisy = 1;    /* features of the noise that moves them, a blob */
            uniform float var = 1;      /* the same across, as a part of noisy */
            uniform float amp = .5;     /* how far it moves them, in blobs */
            uniform float size = .48;   /* radius of blobs, in blobs; 0.58 leaves no room between them */
            uniform float edge = .02;   /* softness of their edges */
            /* The material. */
            uniform float Ka = 1, Kd = .5, Ks = .5, roughness = .1; /* of the clear part: parts of light, highlight width */
            uniform color specularcolor = 1;                        /* of highlights */
            uniform color tint = 1;     /* of what is seen through it */
            /* By rays. */
            uniform float angle = 2.5;  /* half angle of the cone of rays, degrees */
            uniform float samples = 128; /* rays a point, for the camera */
            uniform float falloff = .25; /* part of the samples at points that rays see; 1: all of them */
            /* By passes. */
            uniform string background = "";      /* picture of what is behind */
            uniform string backgrounddepth = ""; /* and its depths: blur by distance, with angle; "" takes rad everywhere */
            uniform float rad = .01;             /* half width of the blur, as a part of the picture */
            output varying float blob = 0;       /* 1 where it is frosted */
            )
{
  point Pshade = transform("shader", P);
  blob = frostedblobs(xcomp(Pshade), ycomp(Pshade), period, noisy, var, amp, size, edge);

  if (phase == "mask") {
    Oi = blob;
    Ci = 0;
  } else {
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    color Cclear = Cs * (Ka * ambient() + Kd * diffuse(Nf));
    color Cshine = Ks > 0 ? specularcolor * Ks * specular(Nf, -In, roughness) : 0;
    if (phase == "behind") {
      Oi = Os * (1 - blob);
      Ci = Oi * (Cclear + Cshine);
    } else {
      color Cthrough = 0;
      if (blob > 0) {
        if (phase == "trace") {
          Cthrough = seenthrough(P, In, radians(angle), raysat(samples, falloff));
        } else {
          float blur = rad;
          if (backgrounddepth != "")
            blur = radbehind(backgrounddepth, P, radians(angle));
          Cthrough = seenbehind(background, P, blur);
        }
      }
      Oi = Os;
      Ci = Os * (mix(Cclear, tint * Cthrough, blob) + Cshine);
    }
  }
}

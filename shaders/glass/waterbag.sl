/* waterbag.sl: a bag of water, in four passes, without rays.
 *
 *   1  an environment map from the middle of the bag, without it;
 *   2  part = "back": the far half of the bag seen from inside, opaque, coloured by the environment alone;
 *   3  what is in the bag, alone, from the viewing camera (any shader), with alpha;
 *   4  part = "front": the near half. It mirrors the environment and bends what is behind: the picture of pass 2 with that of pass 3 before it.
 *
 * Bending is by normals: "warped" ones, that waves of the skin of the bag move.
 */
#include "projectedpicture.h"

surface
waterbag(uniform string part = "front";     /* or "back" */
         uniform string envmap = "";        /* of pass 1; "" for none */
         uniform string envspace = "world"; /* its axes */
         uniform string back = "";          /* picture of pass 2 */
         uniform string contents = "";      /* picture of pass 3 */
         uniform float eta = 1.33;          /* refractive index of the inside: water */
         uniform float Kreflect = 1, Krefract = 1;  /* strengths of mirroring, 1: as physics says, and of what is seen through */
         uniform float waves = 0.1, wavesize = 0.4; /* of the skin: height as a part of their size, shader space */
         uniform float bend = 0.15;         /* how far pictures behind are moved, as a part of them, where the skin is seen edge on */
         uniform color tint = color (0.9, 0.97, 1); /* of what is seen through each half */
         uniform float Ks = 0.8, roughness = 0.03;  /* highlights of lamps; their width */
         )
{
  point q = transform("shader", P) / wavesize;
  vector move = vector noise(q) - vector (0.5, 0.5, 0.5);
  normal Nw = normalize(normalize(N) + normal (waves * vtransform("shader", "current", move)));
  normal Nf = faceforward(Nw, I);
  vector In = normalize(I), V = -In;
  color shine = Ks * specular(Nf, V, roughness);
  float reflected, refracted;
  paneweights(I, Nf, eta, Kreflect, reflected, refracted);
  color mirrored = 0;
  if (envmap != "")
    mirrored = color environment(envmap, vtransform(envspace, reflect(In, Nf)));

  if (part == "back") {
    /* Leaving the water: directions bend away from the normal, or all is mirrored inside. */
    vector out = refract(In, Nf, eta);
    color seen = mirrored;
    if (envmap != "" && length(out) > 0)
      seen = color environment(envmap, vtransform(envspace, out));
    Oi = 1;
    Ci = tint * seen + shine;
  } else {
    /* Where the skin turns away from the viewer, what is behind is seen farther to the side. */
    vector side = vtransform("current", "camera", vector Nf);
    float soffset = -bend * xcomp(side) * abs(xcomp(side)), toffset = bend * ycomp(side) * abs(ycomp(side));
    float ss, tt;
    color behind = 0;
    /* Beside the far half there is what is around the bag. */
    if (envmap != "")
      behind = color environment(envmap, vtransform(envspace, refract(In, Nf, 1 / eta)));
    if (back != "") {
      if (pictureplace(back, P, ss, tt) != 0) {
        color far = color texture(back, ss + soffset, tt + toffset);
        float there = float texture(back[3], ss + soffset, tt + toffset, "fill", 1);
        behind = far + (1 - there) * behind;
      }
    }
    if (contents != "") {
      if (pictureplace(contents, P, ss, tt) != 0) {
        color inside = color texture(contents, ss + soffset, tt + toffset);
        float alpha = float texture(contents[3], ss + soffset, tt + toffset, "fill", 1);
        behind = inside + (1 - alpha) * behind;
      }
    }
    Oi = Os;
    Ci = Os * (shine + reflected * mirrored + Krefract * refracted * tint * behind);
  }
}

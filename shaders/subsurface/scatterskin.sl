/* scatterskin.sl: skin by scatter maps, whose samples are lit when the first grid near them is shaded: no pass for light, so that lights may
 * change without anything else being made anew. Mixed with plain diffuse light, which keeps what is finer than the samples; relief; an
 * oily coat.
 *
 *     Ci = Cs map (Ka ambient + Kd mix(diffuse, scattered, amount)) + Kcoat coat
 *
 * Passes: bakescatter.sl over Procedural "Fragment" makes the map (once for a pose of the model); then the picture. With amount 0 it is the
 * same skin without anything below: a BRDF to compare with. Light spreads from where the surface was before displacement, which a
 * displacement shader says by its output variable P0.
 *
 * After "Human Skin for Finding Nemo" (Tomson, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 5).
 */
#include "scattermap.h"
#include "skin.h"

surface
scatterskin(uniform string map = "";         /* scatter map, or a cloud (.ply) */
            uniform float width = .1;        /* how far light spreads at most, "world" space: about 4.5 mean distances, above 0 */
            uniform color tint = 1;          /* of the light that spreads, 0 to 1 */
            uniform float amount = .7;       /* 0 to 1: part of the light that spreads */
            uniform string colormap = "";    /* the skin's colour under diffuse light, by s and t, times Cs; "": Cs alone */
            uniform float Ka = 0, Kd = 1;    /* 0 to 1 */
            /* The surface. */
            uniform float cell = .02, depth = 0; /* of its relief: width of cells and depth of creases, "world" space; 0: smooth */
            uniform float Ks = .2;           /* 0 to 1: weight of the coat */
            uniform float coateta = 1.4;     /* index of refraction of the oil, 1 to 2 */
            uniform float oily = .16, rough = .38; /* slopes of two layers, 0.02 to 0.5 */
            uniform float oiliness = .35;    /* 0 to 1: part of the first */
            output varying float __overrideDerivs = 0, __derivA = 0; /* messages to lights: mapshadow.h */
            output varying color spread = 0; /* what came by the map */
            )
{
  normal Nn = normalize(N), Nb = Nn;
  color albedo = Cs;
  if (colormap != "") albedo *= color texture(colormap);
  if (depth > 0) {
    uniform float unit = length(vtransform("world", "current", vector (0, 1, 0)));
    point q = transform("shader", P) / cell;
    Nb = bumped(P, Nn, normalize(Ng), depth * unit * skinrelief(q, filterwidthp(q)));
  }
  /* First of all: what re-lights pictures keeps all that comes before. */
  color lit = diffuse(Nb);
  if (amount > 0 && map != "") {
    point P0 = P;
    displacement("P0", P0);
    spread = scattermap(P0, Nn, map, width, tint, __overrideDerivs, __derivA);
    lit = mix(lit, spread, amount);
  }
  color coat = 0;
  if (Ks > 0) coat = skincoat(P, faceforward(Nb, I), -normalize(I), coateta, oily, rough, oiliness);
  Oi = Os;
  Ci = Os * (albedo * (Ka * ambient() + Kd * lit) + Ks * coat);
}

// Looks back where the ray came from, by a ray of half the weight: how many surfaces that makes; or what trace() sees there.
surface halfmirror(uniform float angle = 0, traces = 0; output varying float met = 0; output varying color seen = 0;) {
  float behind = 0;
  if (traces != 0)
    seen = trace(P, -I);
  else
    gather("illuminance", P, -I, angle, 1, "surface:met", behind, "weight", .5) ;
  met = 1 + behind;
  Oi = 1;
  Ci = .5;
}

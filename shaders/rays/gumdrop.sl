/* gumdrop.sl: sugar coating over something murky: rays go on into the inside, and what they meet is seen the less, the deeper it lies.
 *
 * With d the mean distance of what is inside, the coating counts with (d / depth)^(log falloff / log 1/2): falloff at half the depth.
 */
surface
gumdrop(uniform float Ka = .1, Kd = .2, Ks = .65, roughness = .04; /* of the coat: parts of ambient, diffuse, specular light; highlight width */
        uniform float depth = 2;        /* farther in nothing is seen */
        uniform float falloff = .955;   /* part of the coating at half the depth, 0 to 1 */
        uniform float samples = 1;      /* antialias what is inside, also with a cone of 0 */
        uniform float cone = 0;         /* half angle of the cone of rays, radians: murkiness */
        output varying float inside = 0; /* mean distance of what was seen; depth where nothing was */
        )
{
  normal Nf = faceforward(normalize(N), I);
  vector In = normalize(I);
  color coat = Cs * (Ka * ambient() + Kd * diffuse(Nf)), c = 0, sum = 0;
  float d = 0, total = 0;

  gather("illuminance", P, In, cone, samples, "surface:Ci", c, "ray:length", d, "maxdist", depth) {
    float bury = pow(min(d / depth, 1), log(falloff) / log(0.5));
    sum += mix(c, coat, bury);
    total += d;
  } else {
    sum += coat;
    total += depth;
  }
  inside = total / samples;
  Oi = Os;
  Ci = Os * (sum / samples + Ks * specular(Nf, -In, roughness));
}

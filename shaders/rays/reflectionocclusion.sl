/* reflectionocclusion.sl: how much of what is in the mirror direction is blocked by something, for use with reflections from maps.
 *
 * Adaptive: where the first minsamples rays agree, the others are not shot. That is biased (the rays that are left out might not agree): for
 * drafts. minsamples = samples shoots all.
 */
surface
reflectionocclusion(uniform float minsamples = 4, samples = 32; /* rays a point: at least, at most */
                    uniform float blur = 0;      /* half angle of the cone of rays, radians; 0: the samples antialias */
                    uniform float maxdist = 1e30;               /* things farther away do not count, "current" space */
                    uniform float visualize = 0; /* 1: shows where all samples were taken, in red */
                    output varying float blocked = 0; /* 0 to 1 */
                    output varying float shot = 0;    /* rays */
                    )
{
  vector In = normalize(I);
  normal Nn = normalize(N);
  vector R = reflect(In, faceforward(Nn, I));
  float facing = (In . Nn) * (In . Nn);
  float hits = 0, count = 0;

  if (minsamples < samples) {
    gather("occlusion", P, R, blur, samples, "maxdist", maxdist) {
      hits += 1;
      count += 1;
      if (count >= minsamples && hits == count)
        break;
    } else {
      count += 1;
      if (count >= minsamples && hits == 0)
        break;
    }
  } else {
    /* Without a break all rays are shot at once. */
    gather("occlusion", P, R, blur, samples, "maxdist", maxdist) {
      hits += 1;
    }
    count = samples;
  }
  shot = count;
  blocked = hits / max(count, 1);
  Oi = Os;
  if (visualize != 0)
    Ci = Os * mix(0.75 * facing * Cs, color (1, 0.1, 0.1), count / samples);
  else
    Ci = Os * (facing * Cs + color (blocked)) / 2;
}

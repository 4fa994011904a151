/* eye.sl: an eyeball, a sphere about the origin of "object" space whose iris is round +z: veined white, iris with a rim, pupil, a wet coat. */
#include "noises.h"
#include "scattering.h"
#include "skin.h"

surface
eye(uniform color white = color (0.78, 0.72, 0.66), iris = color (0.5, 0.33, 0.04), rim = color (0.06, 0.05, 0.02);
    uniform float irissize = 0.62, pupilsize = 0.24; /* half angles seen from the middle, radians */
    uniform color sky = color (0.35, 0.42, 0.5);     /* mirrored from above */
    )
{
  vector d = normalize(vector transform("object", P));
  float away = acos(clamp(zcomp(d), -1, 1)), round = atan(ycomp(d), xcomp(d));
  float streaks = noise(point (14 * cos(round), 14 * sin(round), 3 * away));
  float ring = smoothstep(pupilsize, pupilsize + 0.1, away);
  color c = mix(iris * 0.5, iris * 1.9, ring * streaks);
  c = mix(c, rim, smoothstep(irissize - 0.14, irissize - 0.01, away));
  c *= smoothstep(pupilsize - 0.03, pupilsize + 0.02, away);
  float vein = smoothstep(0.85, 1, 1 - abs(float snoise(point (5 * cos(round), 5 * sin(round), 2.5 * away))));
  color ball = mix(white, color (0.6, 0.15, 0.1), 0.45 * vein * smoothstep(0.75, 1.2, away));
  c = mix(c, ball, smoothstep(irissize - 0.02, irissize + 0.05, away));
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  vector R = normalize(vtransform("world", reflect(-V, Nf)));
  Oi = 1;
  Ci = c * (ambient() + diffuse(Nf)) + skincoat(P, Nf, V, 1.5, 0.05, 0.15, 0.8) +
       (1 - fresneltransmittance(V . Nf, 1.4)) * sky * smoothstep(-0.2, 0.8, ycomp(R));
}

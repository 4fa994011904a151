/* tiles.sl: a floor of square tiles, no two of quite the same colour, with joints between them. The joints are averaged
 * over the element, so that they do not break up in the distance. Up to three round things that stand on the floor
 * darken it: given by centre and radius.
 */
surface
tiles(float Ka = 1, Kd = 0.9, Ks = 0.25, roughness = 0.12;
      float tilesize = 0.8, joint = 0.035;
      color first = color(0.80, 0.73, 0.62);
      color second = color(0.46, 0.26, 0.19);
      color jointcolor = color(0.25, 0.24, 0.23);
      uniform point centers[3] = { point (0, 0, 0), point (0, 0, 0), point (0, 0, 0) };
      uniform float radii[3] = { 0, 0, 0 };)
{
  point p = transform("world", P);
  float x = xcomp(p) / tilesize, z = zcomp(p) / tilesize;
  float column = floor(x), row = floor(z);
  float fx = x - column, fz = z - row;

  /* The part of this element that lies in a joint. */
  float w = max(abs(Du(x) * du) + abs(Dv(x) * dv), abs(Du(z) * du) + abs(Dv(z) * dv));
  float edge = min(min(fx, 1 - fx), min(fz, 1 - fz));
  float tile = smoothstep(joint - 0.5 * w, joint + 0.5 * w + 0.01, edge);

  color base = mod(column + row, 2) < 1 ? first : second;
  base *= 0.85 + 0.3 * float cellnoise(column, row);
  base *= 0.9 + 0.2 * float noise(6 * p) * float noise(23 * p);
  base = mix(jointcolor, base, tile);

  float shade = 1;
  uniform float i;
  for (i = 0; i < 3; i += 1) {
    if (radii[i] > 0) {
      float d = distance(P, centers[i]) / radii[i];
      shade *= 1 - 0.75 * (1 - smoothstep(0.3, 1.35, d));
    }
  }

  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  float distant = smoothstep(9, 22, length(I));
  Oi = Os;
  Ci = base * shade * (Ka * ambient() + Kd * diffuse(Nf)) + tile * shade * Ks * specular(Nf, V, roughness);
  Ci = Os * mix(Ci, color(0.62, 0.71, 0.80), distant);
}

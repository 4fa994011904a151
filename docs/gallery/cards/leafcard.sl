/* leafcard.sl: a leaf on nothing, as a picture with alpha: a blade between two arcs, with veins. */
surface
leafcard(uniform color near = color (0.2, 0.5, 0.08), far = color (0.75, 0.6, 0.1);
         uniform float lobes = 0; /* a ragged edge: how many teeth a side */
         )
{
  float x = 2 * s - 1, y = 1 - 2 * t;
  float along = (y + 0.95) / 1.9;
  float half = 0.62 * pow(max(sin(PI * clamp(along, 0, 1)), 0), 0.8) * (1 - 0.35 * along);
  if (lobes > 0)
    half *= 0.78 + 0.22 * abs(sin(PI * lobes * along));
  float blade = along > 0 && along < 1 ? 1 - smoothstep(half - 0.02, half, abs(x)) : 0;
  float stalk = (1 - smoothstep(0.025, 0.04, abs(x))) * (1 - smoothstep(-0.7, -0.65, y));
  float alpha = max(blade, stalk);
  float side = abs(x) / 0.62;
  float vein = mod(7 * along - 2.2 * side, 1);
  vein = min(vein, 1 - vein);
  float line = max(1 - smoothstep(0.02, 0.05, vein), 1 - smoothstep(0.012, 0.028, abs(x)));
  color c = mix(near, far, clamp(along + 0.3 * (float noise(7 * s, 7 * t) - 0.5), 0, 1));
  c *= 0.75 + 0.5 * float noise(30 * s, 30 * t);
  Oi = alpha;
  Ci = alpha * mix(c, 1.5 * c + 0.05, 0.6 * line);
}

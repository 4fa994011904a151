/* dome.sl: all around, a gradient from the horizon up, and one colour below. */
surface
dome(uniform color horizon = color (0.55, 0.62, 0.7), zenith = color (0.1, 0.2, 0.42), ground = color (0.4, 0.4, 0.38);)
{
  float up = ycomp(normalize(vector transform("world", P)));
  Oi = 1;
  Ci = up < 0 ? ground : mix(horizon, zenith, smoothstep(0, 0.7, up));
}

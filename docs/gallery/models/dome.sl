/* dome.sl: all around, a gradient from the horizon up. */
surface
dome(uniform color horizon = color (0.55, 0.62, 0.7), zenith = color (0.1, 0.2, 0.42);)
{
  float up = ycomp(normalize(vector transform("world", P)));
  Oi = 1;
  Ci = mix(horizon, zenith, smoothstep(0, 0.7, up));
}

/* water.sl: all around, the blue of deep water, brighter towards the surface. */
surface
water(uniform color deep = color (0.004, 0.03, 0.07), bright = color (0.12, 0.45, 0.55);)
{
  float up = ycomp(normalize(vector transform("world", P)));
  Oi = 1;
  Ci = mix(deep, bright, smoothstep(-0.35, 0.75, up + 0.1 * (float noise(0.5 * transform("world", P)) - 0.5)));
}

/* gourd.sl: lobes from pole to pole, with warts between them. Moves the surface, so that the outline shows it too.
 *
 *     height = lobedepth |cos(lobes PI s)| + wartsize bumps(P)
 */
displacement
gourd(float lobes = 9;         /* how many; whole, so that the seam closes */
      float lobedepth = 0.16;
      float wartsize = 0.05;
      float wartfrequency = 9;
      output varying float height = 0;)
{
  point p = transform("object", P);
  normal Nn = normalize(N);

  float lobe = abs(cos(lobes * PI * s));
  float poles = sin(PI * t);             /* nothing moves at the poles, where s meets itself */
  float warts = smoothstep(0.55, 0.8, float noise(wartfrequency * p));
  height = poles * (lobedepth * lobe + wartsize * warts * lobe);

  P += height * Nn;
  N = calculatenormal(P);
}

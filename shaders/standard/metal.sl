/* metal.sl: bare metal, whose highlights have the colour of the metal itself (RISpec 3.2, A.1.3).
 *
 *     Ci = Os Cs (Ka ambient() + Ks specular(Nf, V, roughness))
 */
surface
metal(float Ka = 1;         /* weight of ambient light */
      float Ks = 1;         /* weight of highlights */
      float roughness = .1; /* spread of highlights: the smaller, the sharper */
      )
{
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);

  Oi = Os;
  Ci = Os * Cs * (Ka * ambient() + Ks * specular(Nf, V, roughness));
}

/* plastic.sl: a coloured body under a clear skin, which highlights in a colour of its own (RISpec 3.2, A.1.5).
 *
 *     Ci = Os (Cs (Ka ambient() + Kd diffuse(Nf)) + specularcolor Ks specular(Nf, V, roughness))
 */
surface
plastic(float Ka = 1;            /* weight of ambient light */
        float Kd = .5;           /* weight of diffuse light */
        float Ks = .5;           /* weight of highlights */
        float roughness = .1;    /* spread of highlights: the smaller, the sharper */
        color specularcolor = 1; /* colour of highlights */
        )
{
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);

  Oi = Os;
  Ci = Os * (Cs * (Ka * ambient() + Kd * diffuse(Nf)) + specularcolor * Ks * specular(Nf, V, roughness));
}

/* paintedplastic.sl: plastic with a texture map painted on its body (RISpec 3.2, A.1.6).
 *
 *     Ci = Os (Cs texture(texturename) (Ka ambient() + Kd diffuse(Nf))
 *              + specularcolor Ks specular(Nf, V, roughness))
 *
 * Without a map the body has the plain colour of the primitive: the same as plastic.
 */
surface
paintedplastic(float Ka = 1;            /* weight of ambient light */
               float Kd = .5;           /* weight of diffuse light */
               float Ks = .5;           /* weight of highlights */
               float roughness = .1;    /* spread of highlights: the smaller, the sharper */
               color specularcolor = 1; /* colour of highlights */
               string texturename = ""; /* texture map, "" for none */
               )
{
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  color Ct = Cs;

  if (texturename != "")
    Ct *= color texture(texturename);
  Oi = Os;
  Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) + specularcolor * Ks * specular(Nf, V, roughness));
}

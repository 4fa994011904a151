/* shinymetal.sl: polished metal, which mirrors an environment map (RISpec 3.2, A.1.4).
 *
 *     Ci = Os Cs (Ka ambient() + Ks specular(Nf, V, roughness) + Kr environment(texturename, D))
 *
 * D is the mirrored direction in "world" space, so that the map stays where it is when the camera moves. Without a
 * map there is nothing to mirror, and the last term is 0.
 */
surface
shinymetal(float Ka = 1;           /* weight of ambient light */
           float Ks = 1;           /* weight of highlights */
           float Kr = 1;           /* weight of the mirrored environment */
           float roughness = .1;   /* spread of highlights: the smaller, the sharper */
           string texturename = ""; /* environment map, "" for none */
           )
{
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  color mirrored = 0;

  if (texturename != "") {
    vector D = vtransform("current", "world", reflect(I, normalize(Nf)));
    mirrored = color environment(texturename, D);
  }
  Oi = Os;
  Ci = Os * Cs * (Ka * ambient() + Ks * specular(Nf, V, roughness) + Kr * mirrored);
}

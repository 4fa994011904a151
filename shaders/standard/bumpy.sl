/* bumpy.sl: moves the surface along its normal by a texture map (RISpec 3.2, A.4.1).
 *
 *     P += Km texture(texturename) normalize(N),   N = the normal of the moved surface
 *
 * Without a map the surface stays as it is.
 */
displacement
bumpy(float Km = 1;            /* how far a map value of 1 moves the surface */
      string texturename = ""; /* texture map of heights, "" for none */
      )
{
  if (texturename != "") {
    float amplitude = Km * float texture(texturename, s, t);
    P += amplitude * normalize(N);
    N = calculatenormal(P);
  }
}

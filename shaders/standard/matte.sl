/* matte.sl: a surface that scatters light evenly in all directions, after Lambert (RISpec 3.2, A.1.2).
 *
 *     Ci = Os Cs (Ka ambient() + Kd diffuse(Nf))
 */
surface
matte(float Ka = 1; /* weight of ambient light */
      float Kd = 1; /* weight of diffuse light */
      )
{
  normal Nf = faceforward(normalize(N), I);

  Oi = Os;
  Ci = Os * Cs * (Ka * ambient() + Kd * diffuse(Nf));
}

/* distantlight.sl: parallel light from far away, like the sun's (RISpec 3.2, A.2.2).
 *
 *     Cl = intensity lightcolor
 *
 * Only the direction between the two points counts, not where they are.
 */
light
distantlight(float intensity = 1;                     /* brightness */
             color lightcolor = 1;                    /* colour */
             point from = point "shader" (0, 0, 0);   /* the light shines from here */
             point to = point "shader" (0, 0, 1);     /* in the direction of this point */
             )
{
  solar(to - from, 0)
    Cl = intensity * lightcolor;
}

/* ambientlight.sl: light without a direction, the same everywhere (RISpec 3.2, A.2.1).
 *
 *     Cl = intensity lightcolor
 *
 * Only ambient() sees it: there is neither an illuminate nor a solar statement, so light loops pass it by.
 */
light
ambientlight(float intensity = 1;  /* brightness */
             color lightcolor = 1; /* colour */
             )
{
  Cl = intensity * lightcolor;
}

/* pointlight.sl: a small lamp, which shines in all directions (RISpec 3.2, A.2.3).
 *
 *     Cl = intensity lightcolor / |L|^2
 */
light
pointlight(float intensity = 1;                   /* brightness at distance 1 */
           color lightcolor = 1;                  /* colour */
           point from = point "shader" (0, 0, 0); /* position of the lamp */
           )
{
  illuminate(from)
    Cl = intensity * lightcolor / (L . L);
}

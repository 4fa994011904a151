/* fog.sl: evenly thick fog between the viewer and the surface (RISpec 3.2, A.3.2).
 *
 *     d = 1 - exp(-|I| / distance)
 *     Ci = mix(Ci, background, d)        Oi = mix(Oi, 1, d)
 */
volume
fog(float distance = 1;   /* after this way 1/e, about 37 %, of the light is left */
    color background = 0; /* colour of the fog */
    )
{
  float d = 1 - exp(-length(I) / distance);

  Ci = mix(Ci, background, d);
  Oi = mix(Oi, color (1, 1, 1), d);
}

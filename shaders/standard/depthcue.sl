/* depthcue.sl: fades into a background colour with depth (RISpec 3.2, A.3.1).
 *
 *     d = clamp((depth(P) - mindistance) / (maxdistance - mindistance), 0, 1)
 *     Ci = mix(Ci, background, d)        Oi = mix(Oi, 1, d)
 *
 * Distances are fractions of the way from the near to the far clipping plane, as depth() counts it.
 */
volume
depthcue(float mindistance = 0; /* nearer than this nothing is faded */
         float maxdistance = 1; /* farther than this only the background is seen */
         color background = 0;  /* what is faded into */
         )
{
  float d = clamp((depth(P) - mindistance) / (maxdistance - mindistance), 0, 1);

  Ci = mix(Ci, background, d);
  Oi = mix(Oi, color (1, 1, 1), d);
}

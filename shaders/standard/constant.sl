/* constant.sl: the colour of the primitive, whatever the light (RISpec 3.2, A.1.1).
 *
 *     Ci = Os Cs
 */
surface
constant()
{
  Oi = Os;
  Ci = Os * Cs;
}

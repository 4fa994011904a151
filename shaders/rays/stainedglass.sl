/* stainedglass.sl: a pane of coloured glass. What it lets through and what it shows of itself are not tied to each other: light from behind
 * has the colour of the glass, and so have shadows of lights that ask transmission().
 *
 *     Oi = 1 - x, Ci = x^deepen show, x being the colour of the glass
 *
 * Its shadow needs Attribute "visibility" "transmission" "shader".
 */
surface
stainedglass(uniform string texturename = ""; /* colours of the glass; lead is black. "": Cs */
             uniform float deepen = 2;        /* more than 1: the glass itself is deeper in colour than its shadow */
             uniform float show = 1;          /* how bright the glass itself is */
             )
{
  color x = Cs;
  if (texturename != "")
    x *= color texture(texturename);
  Oi = 1 - x;
  Ci = show * color (pow(comp(x, 0), deepen), pow(comp(x, 1), deepen), pow(comp(x, 2), deepen));
}

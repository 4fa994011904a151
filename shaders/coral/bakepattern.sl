/* bakepattern.sl: a pattern of organicpatterns.h as a picture, to be a map of the corals (patterns 32 to 35, velvetmap and polypmap), which may
 * be painted over. Not for speed: a lookup costs more than most of these patterns. On a square with s and t from 0 to 1, seen whole; one channel
 * is enough for a Display.
 * What shaders would do to the pattern later can be done here once: low and high choose the part of it that counts, gain below 1 sharpens
 * and above 1 fattens.
 */
#include "coral.h"

surface
bakepattern(uniform float pattern = 8;         /* 0 to 31 */
            uniform float features = 16;       /* of the pattern, across the picture */
            uniform float low = 0, high = 1;   /* 0 to 1 */
            uniform float gain = 1;            /* above 0 */
            output varying float height = 0;   /* the result, 0 to 1 */
            )
{
  point q = point (features * s, features * t, 0.5);
  height = polypheight(organicpattern(pattern, q, filterwidthp(q), "", features * s, features * t), low, high, gain, 1);
  Oi = 1;
  Ci = height;
}

/* twistedmirror.sl: a mirror with a mind of its own: reflections that go towards `twist` are drawn farther that way. */
surface
twistedmirror(uniform float Kr = 1;                    /* part of light that is mirrored, 0 to 1 */
              uniform vector twist = vector (0, 0, 0); /* in shader space; its length says how strongly; none: a plain mirror */
              uniform color background = 0;            /* seen where there is nothing */
              )
{
  normal Nn = normalize(N);
  color seen = 0;
  /* Rays may come from inside, too: there is nothing to be seen. */
  if (Nn . I < 0) {
    vector R = reflect(normalize(I), Nn);
    if (length(twist) > 0)
      R += max(R . normalize(twist), 0) * twist;
    color c = 0;
    seen = background;
    gather("illuminance", P, normalize(R), 0, 1, "surface:Ci", c)
      seen = c;
  }
  Oi = Os;
  Ci = Os * Cs * Kr * seen;
}

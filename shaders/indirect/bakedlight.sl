/* bakedlight.sl: matte, lit by lamps and by light from other surfaces, as bleeding.sl; for files of irradiance.
 *
 * Attribute "irradiance" "handle" and "filemode" say which file, and how it is used. Only the side that the normal points to is
 * lit while a file is made (onesided): what faces away is to be baked, too, and not its back.
 */
surface
bakedlight(uniform float Kd = 1;           /* part of the light that is reflected, 0 to 1 */
           uniform float Kindirect = 1;    /* less: what was baked elsewhere is too much here */
           uniform float samples = 64;     /* rays a point */
           uniform float maxdist = 1e30;   /* farther surfaces give nothing */
           uniform string space = "world"; /* data are kept in this space, and go where it goes */
           uniform float onesided = 0;     /* 1: only the side that the normal points to is lit */
           uniform float reference = 0;    /* 1: look up at Pref, where the surface was when they were kept */
           varying point Pref = 0;         /* of the primitive: the same points before they moved, shader space */
           output varying color indirect = 0; /* light from other surfaces, before Kd */
           )
{
  normal Nn = onesided != 0 ? normalize(N) : shadingnormal(N);
  point where = reference != 0 ? Pref : P;
  indirect = indirectdiffuse(where, Nn, samples, "maxdist", maxdist, "coordsystem", space);
  Oi = Os;
  Ci = Os * Cs * Kd * (diffuse(Nn) + Kindirect * indirect);
}

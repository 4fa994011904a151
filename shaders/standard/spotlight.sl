/* spotlight.sl: a lamp with a reflector: a cone of light, brightest along its axis (RISpec 3.2, A.2.4).
 *
 *     Cl = intensity lightcolor c^beamdistribution / |L|^2
 *              smoothstep(cos(coneangle), cos(coneangle - conedeltaangle), c)
 *
 * c is the cosine of the angle between the axis and L. Angles are half angles, in radians.
 */
light
spotlight(float intensity = 1;                   /* brightness at distance 1 on the axis */
          color lightcolor = 1;                  /* colour */
          point from = point "shader" (0, 0, 0); /* position of the lamp */
          point to = point "shader" (0, 0, 1);   /* a point on the axis of the cone */
          float coneangle = radians(30);         /* from the axis to the edge of the cone */
          float conedeltaangle = radians(5);     /* width of the soft edge, inside the cone */
          float beamdistribution = 2;            /* the larger, the faster the light falls off beside the axis */
          )
{
  uniform vector A = normalize(to - from);

  illuminate(from, A, coneangle) {
    float c = (L . A) / length(L);
    float falloff = pow(c, beamdistribution) / (L . L);
    falloff *= smoothstep(cos(coneangle), cos(coneangle - conedeltaangle), c);
    Cl = falloff * intensity * lightcolor;
  }
}

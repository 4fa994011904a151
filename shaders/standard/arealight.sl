/* arealight.sl: a shining surface, for AreaLightSource. It is equally bright from all directions in front of
 * it, as a matte lamp is, so that it sends light by the cosine to its normal.
 *
 *     Cl = intensity lightcolor cos(N, L) / |L|^2
 *
 * The light of a small surface is that of a pointlight of the same intensity, seen from straight ahead; a
 * larger surface shines as brightly in all.
 */
light
arealight(float intensity = 1;    /* brightness at distance 1, straight ahead */
          color lightcolor = 1;   /* colour */
          string shadowname = ""; /* a shadow map, or "raytrace" */
          )
{
  illuminate(P, N, PI / 2) {
    Cl = intensity * lightcolor * (normalize(N) . normalize(L)) / (L . L);
    if (shadowname != "")
      Cl *= 1 - shadow(shadowname, Ps);
  }
}

/* sky.sl: a sky as a picture of all directions: s is longitude, t latitude from above, y up. With a sun far brighter than white. */
surface
sky(uniform color zenith = color (0.12, 0.3, 0.75), horizon = color (0.75, 0.82, 0.9), ground = color (0.16, 0.12, 0.08);
    uniform vector sun = vector (0.6, 0.5, -0.6);
    uniform color suncolor = color (1, 0.85, 0.6);
    uniform float sunpower = 60, sunsize = 0.12; /* brightness; radius in radians */
    uniform float clouds = 0.5;
    )
{
  float lon = 2 * PI * s, lat = PI * (0.5 - t);
  vector d = vector (cos(lon) * cos(lat), sin(lat), sin(lon) * cos(lat));
  float up = ycomp(d);
  color c = mix(horizon, zenith, pow(max(up, 0), 0.55));
  if (up > 0) {
    point q = point (xcomp(d), 0, zcomp(d)) / (up + 0.25);
    float f = 0, i, scale = 1;
    for (i = 0; i < 4; i += 1) {
      f += (noise(2.2 * scale * q + 5) - 0.5) / scale;
      scale *= 2;
    }
    c = mix(c, color (0.95, 0.95, 0.97), clouds * smoothstep(0.05, 0.5, f) * smoothstep(0.02, 0.25, up));
  }
  c = mix(ground * (1 + 0.5 * up), c, smoothstep(-0.02, 0.02, up));
  float away = acos(clamp(d . normalize(sun), -1, 1));
  c += suncolor * (sunpower * (1 - smoothstep(0.8 * sunsize, sunsize, away)) + 0.6 * exp(-6 * away));
  Oi = 1;
  Ci = c;
}

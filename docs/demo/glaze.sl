/* glaze.sl: fired clay. Colour runs from one glaze into another along veins of turbulence, with a clear coat that
 * reflects an imagined sky more at grazing angles.
 */
float turbulence(point p; uniform float octaves)
{
  float sum = 0;
  uniform float scale = 1, i;
  for (i = 0; i < octaves; i += 1) {
    sum += abs(2 * float noise(p * scale) - 1) / scale;
    scale *= 2;
  }
  return sum;
}

surface
glaze(float Ka = 1, Kd = 0.8, Ks = 0.6, Kr = 0.5, roughness = 0.06;
      float frequency = 2.2, sharpness = 0.6;
      color deep = color(0.02, 0.16, 0.22);
      color pale = color(0.55, 0.78, 0.66);
      color vein = color(0.93, 0.83, 0.55);)
{
  normal Nf = faceforward(normalize(N), I);
  vector In = normalize(I);

  point p = frequency * transform("object", P);
  float t = turbulence(p + 0.6 * vector(noise(p + 3), noise(p - 5), noise(p + 9)), 5);
  color base = spline(clamp(sharpness * t, 0, 1), deep, deep, deep, pale, vein, pale, deep, deep, deep);

  float kr, kt;
  fresnel(In, Nf, 1 / 1.5, kr, kt);
  vector R = transform("world", P + reflect(In, Nf)) - transform("world", P);
  color sky = mix(color(0.35, 0.33, 0.30), color(0.70, 0.82, 0.95), smoothstep(-0.2, 0.6, ycomp(normalize(R))));

  Oi = Os;
  Ci = Os * (base * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -In, roughness) + Kr * kr * sky);
}

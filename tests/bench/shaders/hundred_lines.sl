/* A shader of ordinary size and habits, for the time that compiling and binding take: weathered planks with nails,
 * moss in the joints and a coat of varnish.
 */
#define PLANKS 5
#define boxstep(a, b, x) clamp(((x) - (a)) / ((b) - (a)), 0, 1)
#define pulse(a, b, fuzz, x) (smoothstep((a) - (fuzz), (a), (x)) - smoothstep((b) - (fuzz), (b), (x)))

float fractal(point p; uniform float octaves, roughness) {
  float sum = 0, amplitude = 1, total = 0;
  point q = p;
  uniform float i;
  for (i = 0; i < octaves; i += 1) {
    sum += amplitude * (2 * float noise(q) - 1);
    total += amplitude;
    q *= 2.03;
    amplitude *= roughness;
  }
  return sum / total;
}

color grain(point p; color light; color dark; float ringscale; uniform float wobble) {
  point q = p + wobble * vector (noise(p * 0.9), noise(p * 0.9 + 17), noise(p * 0.9 - 31));
  float r = ringscale * sqrt(xcomp(q) * xcomp(q) + ycomp(q) * ycomp(q));
  r += 0.3 * noise(r);
  float ring = mod(r, 1);
  ring = smoothstep(0, 0.7, ring) - smoothstep(0.85, 1, ring);
  float fibre = noise(60 * xcomp(q), 60 * ycomp(q)) * noise(1.5 * zcomp(q), 9 * r);
  return mix(light, dark, ring) * (0.85 + 0.3 * fibre);
}

void nail(float x, y; float size; output float inside; output float bump) {
  float d = sqrt(x * x + y * y) / size;
  if (d < 1) {
    inside = 1 - smoothstep(0.8, 1, d);
    bump = sqrt(1 - d * d) * size;
  } else {
    inside = 0;
    bump = 0;
  }
}

surface planks(
  float Ka = 0.6, Kd = 0.8, Ks = 0.3, roughness = 0.15;
  color lightwood = color(0.69, 0.44, 0.25);
  color darkwood = color(0.35, 0.22, 0.08);
  color moss = color(0.18, 0.30, 0.07);
  color rust = color(0.33, 0.14, 0.06);
  float ringscale = 8, wear = 0.5, mossiness = 0.4, jointwidth = 0.03;
  uniform float wobble = 0.12;
  string varnish = "gloss";
  output varying float height = 0;
) {
  /* Which plank, and where on it. */
  float across = s * PLANKS;
  float plank = floor(across), x = across - plank, y = t;
  float shift = cellnoise(plank * 7.31);
  point pshader = transform("shader", P) * (1 + 0.1 * shift) + shift * vector(3, 5, 7);

  /* Joints, with moss where it is damp. */
  float edge = pulse(jointwidth, 1 - jointwidth, 0.01, x);
  float damp = fractal(pshader * 2, 4, 0.5) * 0.5 + 0.5;
  float green = (1 - edge) * smoothstep(1 - mossiness, 1, damp + 0.3);

  /* Wood, bleached where it is worn. */
  color wood = grain(pshader, lightwood, darkwood, ringscale, wobble);
  float worn = wear * boxstep(0.3, 0.8, fractal(pshader * 5, 3, 0.6) + 0.5);
  float grey = comp(wood, 0) * 0.3 + comp(wood, 1) * 0.59 + comp(wood, 2) * 0.11;
  wood = mix(wood, color(grey, grey, grey) * 1.2, worn);

  /* Two nails at each end. */
  float metal = 0, bumps = 0, i;
  for (i = 0; i < 4; i += 1) {
    float nx = mod(i, 2) < 1 ? 0.2 : 0.8;
    float ny = i < 2 ? 0.05 : 0.95;
    float inside, bump;
    nail((x - nx) / PLANKS, y - ny, 0.02, inside, bump);
    metal = max(metal, inside);
    bumps = max(bumps, bump);
  }

  /* Normal from the height of joints, fibres and nails. */
  height = bumps - 0.02 * (1 - edge) + 0.002 * fractal(pshader * 40, 2, 0.5);
  normal Nn = normalize(N);
  normal Nf = faceforward(normalize(calculatenormal(P + height * Nn)), I);
  vector V = -normalize(I);

  color base = mix(mix(wood, moss, green), rust, metal * 0.8);
  float shine = varnish == "gloss" ? 1 : (varnish == "satin" ? 0.4 : 0);
  color highlights = Ks * (1 - green) * specular(Nf, V, roughness);
  if (metal > 0.5) {
    highlights *= base;
  } else if (shine > 0) {
    float kr, kt;
    fresnel(normalize(I), Nf, 1 / 1.5, kr, kt);
    highlights = shine * (highlights + kr * 0.2);
  }
  Oi = Os;
  Ci = Oi * (Cs * base * (Ka * ambient() + Kd * diffuse(Nf)) + highlights);
}

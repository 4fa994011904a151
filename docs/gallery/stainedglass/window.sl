/* window.sl: a leaded window, as a picture: a rose of petals in a field of diamonds, with a border of squares. */
#define RUBY color (0.72, 0.02, 0.03)
#define COBALT color (0.03, 0.09, 0.72)
#define EMERALD color (0.03, 0.5, 0.1)
#define GOLD color (0.98, 0.62, 0.06)
#define VIOLET color (0.35, 0.05, 0.5)

/* 1 within `half` of an edge that is `distance` away. */
float lead(float distance; float half) {
  return 1 - smoothstep(half * 0.75, half, abs(distance));
}
/* Distance to the nearest whole number. */
float toedge(float x) {
  return abs(x - floor(x + 0.5));
}
color chosen(float n) {
  float i = mod(n, 5);
  return i < 1 ? RUBY : i < 2 ? COBALT : i < 3 ? GOLD : i < 4 ? EMERALD : VIOLET;
}

surface
window(uniform float aspect = 1.5; /* height over width */
       uniform float seed = 0;
       uniform float leadwidth = 0.014;
       )
{
  float x = 2 * s - 1, y = (1 - 2 * t) * aspect;
  float line = 0, border = 0.14;
  color glass = 0;
  float inset = min(1 - abs(x), aspect - abs(y));
  float rosey = y - 0.42 * aspect, r = sqrt(x * x + rosey * rosey), angle = atan(rosey, x) / (2 * PI);

  if (inset < border) {
    float along = aspect - abs(y) < 1 - abs(x) ? x : y;
    glass = mod(floor(along / border + 0.5) + seed, 2) < 1 ? RUBY : COBALT;
    line = max(lead(inset - border, leadwidth), lead(toedge(along / border + 0.5) * border, leadwidth), lead(inset, 2 * leadwidth));
  } else if (r < 0.68) {
    float ring = r < 0.16 ? 0 : r < 0.4 ? 1 : 2;
    float count = ring == 2 ? 16 : 8;
    float petal = angle * count + (ring == 2 ? 0.5 : 0);
    glass = ring == 0 ? GOLD : chosen(ring == 1 ? 2 * floor(petal) + seed : floor(petal) + 1 + seed);
    line = max(lead(r - 0.16, leadwidth), lead(r - 0.4, leadwidth), lead(r - 0.68, leadwidth));
    if (ring > 0)
      line = max(line, lead(toedge(petal) / count * 2 * PI * r, leadwidth));
  } else {
    float u = 3.2 * (x + y / 1.5), v = 3.2 * (x - y / 1.5);
    float chance = cellnoise(floor(u) + 11 * seed, floor(v));
    color pale = mix(color (0.85, 0.86, 0.66), color (0.55, 0.8, 0.72), float cellnoise(floor(v), floor(u)));
    glass = chance < 0.72 ? pale : chance < 0.82 ? GOLD : chance < 0.92 ? EMERALD : COBALT;
    line = max(lead(toedge(u) / 4, leadwidth), lead(toedge(v) / 4, leadwidth), lead(r - 0.68, leadwidth), lead(inset - border, leadwidth));
  }
  /* Streaks of the melt. */
  glass *= 0.8 + 0.35 * float noise(9 * x + 3 * seed, 3 * y) - 0.15 * float noise(40 * x, 40 * y);
  Oi = 1;
  Ci = (1 - line) * glass;
}

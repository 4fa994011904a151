surface fabric(float threads = 4) {
  uniform float least = 0, most = 1;
  span(u, least, most);
  Ci = stripes((u - least) / (most - least + 0.001), threads, color "rgb" (0.8, 0.1, 0.1), color(1)) * (1 - 0.2 * stripes(v, threads));
  Oi = 1;
}

/* Rings that get narrower outwards, faster than any pixels can show. */
surface rings() {
  point p = transform("NDC", P);
  float r2 = (xcomp(p) - 0.5) * (xcomp(p) - 0.5) + (ycomp(p) - 0.5) * (ycomp(p) - 0.5);
  Ci = 0.5 + 0.5 * cos(260 * r2);
  Oi = 1;
}

/* What stale.slo is made from in a folder where another stale.sl lies. */
surface stale() {
  Ci = 2;
}

// Rays that go on from where a ray hits: how many hit something.
surface onward(output varying float further = 0) {
  further = 0;
  gather("", P, vector(0, 0, -1), 0, 1) further += 1;
}

// Dim where a diffuse ray hit: what shaders do to save work there.
light typelamp() {
  string type = "";
  float depth = 0;
  rayinfo("type", type);
  rayinfo("diffusedepth", depth);
  illuminate(point "world" (0, 0, -50))
    Cl = type == "diffuse" && depth == 1 ? 0.25 : 1;
}

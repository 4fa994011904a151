// Lets shadow rays through by what they are: 1 - Oi is (type, 1: "transmission"; shadowdepth; isshadowray()) / 4.
surface shadowtold() {
  string type = "";
  float depth = 0;
  rayinfo("type", type);
  rayinfo("shadowdepth", depth);
  Ci = 0;
  Oi = 1 - color (type == "transmission" ? 1 : 0, depth, isshadowray()) / 4;
}

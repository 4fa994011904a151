// Tells what rayinfo() says, and values of every kind.
surface told(output varying float kind = 0, depth = 0, speculardepth = 0, diffusedepth = 0, length = 0, labelled = 0;
             output varying float pair[2] = { 0, 0 }; output varying point origin = 0;
             output varying color weight = 0, place = 0; output varying string name = "";) {
  string text = "";
  rayinfo("type", text);
  kind = text == "specular" ? 1 : text == "diffuse" ? 2 : 0;
  rayinfo("label", text);
  labelled = text == "mine" ? 1 : 0;
  rayinfo("depth", depth);
  rayinfo("speculardepth", speculardepth);
  rayinfo("diffusedepth", diffusedepth);
  rayinfo("length", length);
  rayinfo("origin", origin);
  rayinfo("weight", weight);
  pair[0] = 3;
  pair[1] = 4;
  place = color(u, v, 0);
  name = "told";
  Oi = Os;
  Ci = Oi * Cs;
}

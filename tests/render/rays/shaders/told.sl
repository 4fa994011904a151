// Tells what rayinfo() says, and values of every kind.
surface told(output varying float kind = 0, depth = 0, speculardepth = 0, diffusedepth = 0, length = 0, labelled = 0;
             output varying float pair[2] = { 0, 0 }; output varying point origin = 0;
             output varying color weight = 0, place = 0; output varying string name = "";
             output varying matrix turn = 0; output varying matrix turns[2] = { 0, 0 }; output varying color tints[2] = { 0, 0 };
             output varying string words[2] = { "", "" }; output uniform float list[3] = { 0, 0, 0 };
             output varying vector along = 0; output varying float shadowdepth = 0;) {
  string text = "";
  rayinfo("type", text);
  kind = text == "specular" ? 1 : text == "diffuse" ? 2 : text == "transmission" ? 3 : 0;
  rayinfo("label", text);
  labelled = text == "mine" ? 1 : 0;
  rayinfo("depth", depth);
  rayinfo("speculardepth", speculardepth);
  rayinfo("diffusedepth", diffusedepth);
  rayinfo("shadowdepth", shadowdepth);
  rayinfo("direction", along);
  rayinfo("length", length);
  rayinfo("origin", origin);
  rayinfo("weight", weight);
  pair[0] = 3;
  pair[1] = 4;
  place = color(u, v, 0);
  name = "told";
  turn = matrix (1, 0, 0, 0, 0, 1, 7, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  turns[1] = 9;
  tints[1] = color (1, 0.5, 0.25);
  words[0] = "one";
  words[1] = "two";
  list[0] = 1;
  list[1] = 2;
  list[2] = 3;
  Oi = Os;
  Ci = Oi * Cs;
}

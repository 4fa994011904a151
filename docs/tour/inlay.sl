/* inlay.sl: a picture set into a board. Dust lies where the displacement shader says that there is a groove. */
surface inlay(string picture = "lily.tex"; float Kd = 0.8; output varying color paint = 0) {
  normal Nf = faceforward(normalize(N), I);
  float depth = 0, dust = 0;
  displacement("depth", depth);
  if (depth > 0)
    dust = 0.5;
  paint = texture(picture, s, t);
  Oi = Os;
  Ci = Os * mix(paint, color(0.4), dust) * (ambient() + Kd * diffuse(Nf));
}

/* labelled.sl: plastic that looks different to rays with a label (mirror.sl puts one on its rays). */
surface
labelled(uniform string label = "";                   /* rays that see the other colour; "": none */
         uniform color labelcolor = color (0.2, 0.9, 0.2); /* in place of Cs */
         uniform float Ka = 1, Kd = .5, Ks = .5, roughness = .1; /* parts of ambient, diffuse, specular light; highlight width */
         )
{
  normal Nf = faceforward(normalize(N), I);
  color C = Cs;
  if (label != "" && raylabel() == label)
    C = labelcolor;
  Oi = Os;
  Ci = Os * (C * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -normalize(I), roughness));
}

/* weed.sl: thin leaves, lit from both sides; tone is a primitive variable of weeds.py. */
surface
weed(varying float tone = 1;
     uniform float through = 0.6; /* part of the light from behind */
     )
{
  normal Nf = faceforward(normalize(N), I);
  Oi = 1;
  Ci = Cs * tone * (ambient() + diffuse(Nf) + through * diffuse(-Nf));
}

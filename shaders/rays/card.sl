/* card.sl: a picture with alpha on a flat card. Where alpha is 0 there is nothing: mirrors must look behind it (seethrough.sl),
 * or the card sends the rays on that hit it (goon): each one more deep, so that "maxspeculardepth" bounds how many cards are seen through.
 */
surface
card(uniform string texturename = ""; /* four channels, colour already multiplied by alpha; "": all of the card is there */
     uniform float premultiplied = 1; /* 0: the colour of the picture is not multiplied by its alpha */
     uniform float goon = 0;          /* 1: to rays it is what is seen through it; mirrors need only take the nearest surface then */
     )
{
  color c = 1;
  float alpha = 1;
  if (texturename != "") {
    c = color texture(texturename);
    alpha = float texture(texturename[3]);
    if (premultiplied == 0)
      c *= alpha;
  }
  Oi = Os * alpha;
  Ci = Os * Cs * c;
  if (goon != 0 && raydepth() > 0) {
    if (Oi != color (1))
      Ci += (1 - Oi) * color trace(P, normalize(I));
    Oi = 1;
  }
}

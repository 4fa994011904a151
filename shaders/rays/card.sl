/* card.sl: a picture with alpha on a flat card. Where alpha is 0 there is nothing: mirrors must look behind it (seethrough.sl). */
surface
card(uniform string texturename = ""; /* four channels, colour already multiplied by alpha; "": all of the card is there */
     uniform float premultiplied = 1; /* 0: the colour of the picture is not multiplied by its alpha */
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
}

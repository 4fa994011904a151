/* picture.sl: a picture as it is, pixel by pixel, if ShadingInterpolation is "constant" and ShadingRate 0.25 or less. */
surface
picture(uniform string texturename = "";)
{
  uniform float size[2] = {1, 1};
  textureinfo(texturename, "resolution", size);
  /* The first corner of a micropolygon lies in the first half of a pixel, or on its edge: the middle of that pixel is looked up. */
  float x = (floor(s * size[0] + 0.25) + 0.5) / size[0], y = (floor(t * size[1] + 0.25) + 0.5) / size[1];
  Oi = 1;
  Ci = color texture(texturename, x, y, x, y, x, y, x, y, "lerp", 0);
}

/* projectedpicture.h: pictures laid on surfaces by the cameras that made them, and the cameras of mirrors and of water.
 *
 * After "Reflections and Refractions in Finding Nemo" (Jordan, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 8).
 */
#ifndef ANEMONE_PROJECTEDPICTURE_H
#define ANEMONE_PROJECTEDPICTURE_H

/* Where P is in a picture, 0 to 1 across and down, by the projection matrix that the file of the picture holds. The result is 0 when it
 * holds none.
 */
float pictureplace(string picture; point P; output float ss; output float tt) {
  uniform matrix projection = 1;
  uniform float found = textureinfo(picture, "projectionmatrix", projection);
  point place = transform(projection, P);
  ss = 0.5 + 0.5 * xcomp(place);
  tt = 0.5 - 0.5 * ycomp(place);
  return found;
}

/* The picture at P, moved by an offset and blurred, both as parts of the picture. "" and files without a camera give black, places outside
 * the picture what the file says of its borders.
 */
color projectedpicture(string picture; point P; float soffset; float toffset; float blur) {
  color seen = 0;
  if (picture != "") {
    float ss, tt;
    if (pictureplace(picture, P, ss, tt) != 0)
      seen = color texture(picture, ss + soffset, tt + toffset, "blur", blur);
  }
  return seen;
}

/* Parts of light that a glass pane reflects and lets through, seen along I (any length), from air: Fresnel's formula for the water behind
 * it, bent by strength: 1 as physics says, 0 no reflection at all, more than 1 more than there is.
 */
void paneweights(vector I; normal N; float eta; float strength; output float reflected; output float refracted) {
  float kr, kt;
  fresnel(normalize(I), normalize(N), 1 / eta, kr, kt);
  reflected = clamp(strength * kr, 0, 1);
  refracted = 1 - reflected;
}

#endif

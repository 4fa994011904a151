/* A program in C that draws a wreath of balls: rendered here, or written as RIB to the file it is given.
   docs/c-interface.md goes through it. */
#include <math.h>
#include <ri.h>
#include <stdio.h>

static int balls_made = 0;

/* Makes the geometry of one ball: called when its bound is seen, with the pixels that covers. */
static RtVoid ball(RtPointer data, RtFloat detail) {
  RtFloat *color = data;
  ++balls_made;
  if (detail < 4) return; /* nobody would see it */
  RiColor(color);
  RiSphere(0.3f, -0.3f, 0.3f, 360, RI_NULL);
}

static void wreath(int n) {
  static RtColor colors[32];
  RtBound bound = {-0.3f, 0.3f, -0.3f, 0.3f, -0.3f, 0.3f};
  int i;
  for (i = 0; i < n; ++i) {
    colors[i][0] = 0.5f + 0.5f * cosf(6.2832f * i / n);
    colors[i][1] = 0.5f + 0.5f * cosf(6.2832f * i / n - 2.0944f);
    colors[i][2] = 0.5f + 0.5f * cosf(6.2832f * i / n + 2.0944f);
    RiTransformBegin();
    RiRotate(360.0f * i / n, 0, 0, 1);
    RiTranslate(1.2f, 0, 0);
    RiProcedural(colors[i], bound, ball, RI_NULL);
    RiTransformEnd();
  }
}

int main(int argc, char **argv) {
  RtFloat fov = 30, ambience = 0.2f, roughness = 0.05f;
  RtPoint from = {-1, 1, -1}, to = {0, 0, 0};
  RtPoint card[4] = {{-2, -2, 1}, {-2, 2, 1}, {2, 2, 1}, {2, -2, 1}};
  RtColor shades[4] = {{0.1f, 0.1f, 0.2f}, {0.3f, 0.3f, 0.5f}, {0.3f, 0.3f, 0.5f}, {0.1f, 0.1f, 0.2f}};
  RtFloat height[4] = {0, 1, 1, 0};

  RiBegin(argc > 1 ? argv[1] : RI_NULL);
  RiDisplay("wreath.png", "png", RI_RGBA, RI_NULL);
  RiFormat(160, 160, 1);
  RiPixelSamples(4, 4);
  RiProjection(RI_PERSPECTIVE, RI_FOV, &fov, RI_NULL);
  RiTranslate(0, 0, 7);
  RiWorldBegin();
  RiLightSource("ambientlight", RI_INTENSITY, &ambience, RI_NULL);
  RiLightSource("distantlight", RI_FROM, from, RI_TO, to, RI_NULL);
  RiAttributeBegin();
  RiSurface("matte", RI_NULL);
  /* P and Cs have a value for each of the four vertices; so has "height", as its token declares. */
  RiPolygon(4, RI_P, card, RI_CS, shades, "varying float height", height, RI_NULL);
  RiAttributeEnd();
  RiSurface("plastic", RI_ROUGHNESS, &roughness, RI_NULL);
  wreath(12);
  RiWorldEnd(); /* renders, and calls ball() */
  RiEnd();
  printf("%d balls\n", balls_made);
  return RiLastError == RIE_NOERROR ? 0 : 1;
}

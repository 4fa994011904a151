/* A plug-in for tests: "RADIUS NOTE" makes a ball of the radius, coloured red, and writes what it is told into
   the file NOTE. "split" makes two procedurals of the C interface instead. */
#include <ri.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  float radius;
  char note[200];
} Ball;

static void note(const Ball* ball, const char* what, float detail) {
  FILE* file = fopen(ball->note, "a");
  if (!file) return;
  fprintf(file, "%s %.2f\n", what, detail);
  fclose(file);
}

RtPointer ConvertParameters(RtString parameters) {
  Ball* ball = calloc(1, sizeof *ball);
  if (sscanf(parameters, "%f %199s", &ball->radius, ball->note) != 2) ball->radius = 0;
  note(ball, "converted", ball->radius);
  return ball;
}

static RtVoid small(RtPointer data, RtFloat detail) {
  float r = *(float*)data;
  (void)detail;
  RiSphere(r, -r, r, 360, RI_NULL);
}

RtVoid Subdivide(RtPointer data, RtFloat detail) {
  Ball* ball = data;
  RtColor red = {1, 0, 0};
  float r = ball->radius;
  if (r > 0) {
    note(ball, "detail", detail);
    RiColor(red);
    RiSphere(r, -r, r, 360, RI_NULL);
  } else {
    RtBound left = {-1, 0, -1, 1, -1, 1}, away = {100, 101, 0, 1, 0, 1};
    float* radius = malloc(sizeof *radius);
    *radius = 0.25f;
    RiProcedural(radius, left, small, free);
    radius = malloc(sizeof *radius);
    RiProcedural(radius, away, small, RiProcFree);
    RiSurface("plastic", "Kx", radius, RI_NULL);
  }
}

RtVoid Free(RtPointer data) {
  note(data, "freed", 0);
  free(data);
}

/* Built-in functions written in the language: derivatives and antialiased steps (RISpec 3.2, 15.1).
 *
 * Each function here is the body of the RSLOP row of shadeops.def with its name and parameters. The optional
 * token-value pairs of a row are formals behind the others, named as the tokens and in the order of tokens.def; their
 * initialisers are the values of absent tokens. Bodies may call internal rows.
 */

/* Chain rule along u and v; a direction in which den does not change is left out. */
float Deriv(float num; float den) {
  float du_num = Du(num), dv_num = Dv(num), du_den = Du(den), dv_den = Dv(den);
  return (du_den != 0 ? du_num / du_den : 0) + (dv_den != 0 ? dv_num / dv_den : 0);
}
color Deriv(color num; float den) {
  color du_num = Du(num), dv_num = Dv(num), zero = 0;
  float du_den = Du(den), dv_den = Dv(den);
  return (du_den != 0 ? du_num / du_den : zero) + (dv_den != 0 ? dv_num / dv_den : zero);
}
vector Deriv(vector num; float den) {
  vector du_num = Du(num), dv_num = Dv(num), zero = 0;
  float du_den = Du(den), dv_den = Dv(den);
  return (du_den != 0 ? du_num / du_den : zero) + (dv_den != 0 ? dv_num / dv_den : zero);
}
vector Deriv(point num; float den) {
  vector du_num = Du(num), dv_num = Dv(num), zero = 0;
  float du_den = Du(den), dv_den = Dv(den);
  return (du_den != 0 ? du_num / du_den : zero) + (dv_den != 0 ? dv_num / dv_den : zero);
}
normal Deriv(normal num; float den) {
  normal du_num = Du(num), dv_num = Dv(num), zero = 0;
  float du_den = Du(den), dv_den = Dv(den);
  return (du_den != 0 ? du_num / du_den : zero) + (dv_den != 0 ? dv_num / dv_den : zero);
}

float filterwidth(float x) {
  extern float du, dv;
  return max(abs(Du(x) * du) + abs(Dv(x) * dv), 1e-6);
}

/* box: width 1. triangle: 1 - |t|. gaussian: exp(-2 t^2), cut off at 1. Otherwise catmull-rom, which reaches to 2:
 * 1.5|t|^3 - 2.5 t^2 + 1 within 1, and -0.5|t|^3 + 2.5 t^2 - 4|t| + 2 beyond.
 */
float stepintegral(float t; uniform string filter) {
  float result = 0;
  if (filter == "box") {
    result = clamp(t + 0.5, 0, 1);
  } else if (filter == "triangle") {
    float rest = 1 - min(abs(t), 1);
    float tail = 0.5 * rest * rest;
    result = t < 0 ? tail : 1 - tail;
  } else if (filter == "gaussian") {
    float part = erf(1.41421356 * clamp(t, -1, 1)) / 0.954499736;
    result = 0.5 + 0.5 * part;
  } else {
    float a = min(abs(t), 2);
    float near = ((0.375 * a - 0.833333333) * a * a + 1) * a;
    float far = (((0.833333333 - 0.125 * a) * a - 2) * a + 2) * a - 0.166666667;
    result = 0.5 + sign(t) * (a < 1 ? near : far);
  }
  return result;
}

float filterstep(float edge; float s1; uniform float width = 1; uniform float swidth = 1;
                 uniform string filter = "catmull-rom") {
  float w = max(filterwidth(s1) * width * swidth, 1e-6);
  return stepintegral((s1 - edge) / w, filter);
}
float filterstep(float edge; float s1; float s2; uniform float width = 1; uniform float swidth = 1;
                 uniform string filter = "catmull-rom") {
  float w = max(abs(s2 - s1) * width * swidth, 1e-6);
  return stepintegral((0.5 * (s1 + s2) - edge) / w, filter);
}

/* Powers of colours: compilers of the time took them. */
color pow(color x; color y) {
  return color (pow(comp(x, 0), comp(y, 0)), pow(comp(x, 1), comp(y, 1)), pow(comp(x, 2), comp(y, 2)));
}
color pow(color x; float y) {
  return color (pow(comp(x, 0), y), pow(comp(x, 1), y), pow(comp(x, 2), y));
}

/* normalmirror.sl: a mirror that shows the normals of what is in it as colours: (N + 1) / 2 in the space asked for. */
surface
normalmirror(uniform string space = "world"; /* any coordinate system */
             uniform float shaded = 1;       /* 1: normals as the hit shaders leave them; 0: before they run, which need not run then */
             uniform color background = 0.1; /* seen where there is nothing */
             )
{
  normal Nf = faceforward(normalize(N), I), hit = 0;
  vector R = reflect(normalize(I), Nf);
  color seen = background;

  if (shaded != 0) {
    gather("", P, R, 0, 1, "surface:N", hit)
      seen = color (normalize(ntransform(space, hit))) * 0.5 + 0.5;
  } else {
    gather("", P, R, 0, 1, "primitive:N", hit)
      seen = color (normalize(ntransform(space, hit))) * 0.5 + 0.5;
  }
  Oi = Os;
  Ci = Os * seen;
}

/* mirror.sl: what is seen in a mirror, sharp or as in brushed metal, with a label on its rays by which other shaders know them. */
surface
mirror(uniform float Kr = 1;         /* part of light that is mirrored, 0 to 1; times Cs */
       uniform float blur = 0;       /* half angle of the cone of rays, radians */
       uniform float samples = 1;    /* rays a point */
       uniform string label = "";    /* on the rays: rayinfo("label") at the hit */
       uniform string subset = "";   /* groups that are seen; "": all */
       uniform string envmap = "";   /* seen where there is nothing else; "": background */
       uniform string envspace = "world"; /* the axes of envmap */
       uniform color background = 0;      /* seen where there is nothing, without envmap */
       uniform float Ks = 0, roughness = 0.05; /* highlights of lamps; their width */
       )
{
  normal Nf = faceforward(normalize(N), I);
  vector In = normalize(I), R = reflect(In, Nf), direction = 0;
  color sum = 0, c = 0;

  gather("illuminance", P, R, blur, samples, "surface:Ci", c, "ray:direction", direction, "label", label, "subset", subset) {
    sum += c;
  } else {
    sum += envmap == "" ? background : color environment(envmap, vtransform(envspace, direction));
  }
  color shine = Ks > 0 ? Ks * specular(Nf, -In, roughness) : 0;
  Oi = Os;
  Ci = Os * (Cs * Kr * sum / samples + shine);
}

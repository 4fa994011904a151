/* rayglass.sl: glass or water by rays: mirrored and bent ones, weighted by Fresnel's formula, from inside and outside. The reference for
 * what pictures and tricks come near. Normals point out of the solid. Needs Attribute "trace" "maxspeculardepth" for as many walls as
 * light is to go through.
 */
surface
rayglass(uniform float eta = 1.33;      /* refractive index of the inside */
         uniform color tint = 1;        /* of what is seen through, at each wall */
         uniform float Kreflect = 1, Krefract = 1; /* strengths of both, 1: as physics says */
         uniform float Ks = 0.6, roughness = 0.05; /* highlights of lamps; their width */
         uniform string envmap = "";    /* seen where there is nothing; "": background */
         uniform string envspace = "world";        /* the axes of envmap */
         uniform color background = 0;             /* seen where there is nothing, without envmap */
         )
{
  normal Nn = normalize(N), Nf = faceforward(Nn, I);
  vector In = normalize(I), R = 0, T = 0;
  float kr = 0, kt = 0;
  /* From outside the ratio is 1 / eta. Where all is mirrored inside, kt is 0. */
  fresnel(In, Nf, In . Nn < 0 ? 1 / eta : eta, kr, kt, R, T);
  color mirrored = 0, through = 0, c = 0;
  kr = Kreflect * min(kr, 1);
  kt = Krefract * (1 - min(kr, 1));
  if (length(T) == 0) {
    kr += kt;
    kt = 0;
  }
  if (kr > 0) {
    mirrored = envmap == "" ? background : color environment(envmap, vtransform(envspace, R));
    gather("illuminance", P, R, 0, 1, "surface:Ci", c, "weight", color (kr))
      mirrored = c;
  }
  if (kt > 0) {
    through = envmap == "" ? background : color environment(envmap, vtransform(envspace, T));
    gather("illuminance", P, T, 0, 1, "surface:Ci", c, "weight", color (kt))
      through = c;
  }
  Oi = Os;
  Ci = Os * (kr * mirrored + kt * tint * through + Ks * specular(Nf, -In, roughness));
}

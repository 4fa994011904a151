/* bakedocclusion.sl: the light of an overcast sky, less what is hidden; computed and kept in a file, or looked up in one.
 *
 * Data belong to the side that the surface's own normal points to. When they are kept, that is the only side that is shaded;
 * when they are looked up, both are, as far as they are known.
 */
surface
bakedocclusion(uniform string file = "";       /* an irradiance cache; "": nothing is kept, all is computed */
               uniform string mode = "r";      /* "r" looks up; "w" computes and keeps; "rw" the same, beside what the file holds */
               uniform string space = "world"; /* data are kept in this space, and go where it goes */
               uniform float reference = 0;    /* 1: look up at Pref, where the surface was when they were kept */
               varying point Pref = 0;          /* of the primitive: the same points before they moved, shader space */
               uniform float samples = 64;     /* rays a point */
               uniform float maxdist = 1e30;   /* things farther away hide nothing */
               output varying float occluded = 0; /* hidden part of the sky, 0 to 1 */
               output varying float known = 1; /* 0: the file holds nothing here */
               )
{
  if (file != "" && mode == "r") {
    point where = reference != 0 ? Pref : P;
    known = irradiancecache("query", file, mode, where, shadingnormal(N), "coordsystem", space, "occlusion", occluded);
  } else {
    normal Nn = file == "" ? shadingnormal(N) : normalize(N);
    gather("occlusion", P, Nn, PI / 2, samples, "distribution", "cosine", "maxdist", maxdist)
      occluded += 1;
    occluded /= samples;
    if (file != "")
      irradiancecache("insert", file, mode, P, Nn, "coordsystem", space, "occlusion", occluded);
  }
  Oi = Os;
  Ci = Os * Cs * (1 - occluded);
}

/* bakescatter.sl: a scatter map of what is rendered: position, normal and area of each pixel's piece of surface, in "world" space. For meshes
 * laid out flat by Procedural "Fragment" in "NDC" (docs/subsurface.md), under an orthographic camera.
 *
 * After "Human Skin for Finding Nemo" (Tomson, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9, chapter 5), whose shader writes the
 * area of micropolygons: the sum over all pixels is that of the surface only where the two are of one size.
 */
surface
bakescatter(varying point ScatterPref = point (0, 0, 0);          /* where the surface is, in its own space */
            uniform string ScatterActualObject = "actualobject";  /* the name of that space */
            uniform float ScatterFace = 0;                        /* the number of the face in its mesh */
            output varying point ScatterP = point (0, 0, 0);      /* of the pixel, "world" space */
            output varying normal ScatterN = normal (0, 0, 0);    /* length 1 */
            output varying float ScatterA = 0;                    /* area, "world" space */
            output varying float ScatterF = 0;                    /* that number, for maps by faces */
            )
{
  /* The renderer took the points to be in the space of the flat mesh. */
  point declared = transform("object", ScatterPref);
#pragma nolint
  ScatterP = transform(ScatterActualObject, "world", declared);
  ScatterN = normalize(calculatenormal(ScatterP));
  point pixels = transform("raster", P);
  setzcomp(pixels, 0);
  ScatterA = area(ScatterP) / area(pixels);
  ScatterF = ScatterFace;
  Ci = Oi = 1;
}

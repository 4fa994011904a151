/* bakemesh.sl: the micropolygons of what is rendered as a mesh (PLY), in "world" space, written when the frame ends: slpoints spreads points
 * over it. What the camera does not see is not baked: Attribute "cull" "hidden" 0 and "backfacing" 0 keep it.
 */
surface
bakemesh(uniform string file = "mesh.ply"; /* that is written */)
{
  bakemesh(file, transform("world", P), normalize(ntransform("world", normalize(N))));
  Ci = Oi = 1;
}

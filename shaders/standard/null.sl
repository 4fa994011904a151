/* null.sl: the surface that changes nothing: the colour and opacity of the primitive pass through.
 *
 * Stands in where a shader is asked for and none is wanted: it shows the flat colour. For a primitive that shall not
 * be drawn at all give it Opacity 0.
 */
surface
null()
{
  Ci = Cs;
}

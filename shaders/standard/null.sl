/* null.sl: the surface that changes nothing: the colour and opacity of the primitive pass through.
 *
 * Stands in where a shader is asked for and none is wanted. A surface shader starts with Ci = Cs and Oi = Os, so an
 * empty body shows the flat colour; for a primitive that shall not be drawn at all give it Opacity 0.
 */
surface
null()
{
}

/* background.sl: fills what the image leaves open with one colour (RISpec 3.2, A.5.1).
 *
 *     Ci += (1 - alpha) bgcolor,   Oi = 1,   alpha = 1
 *
 * Some renderers call the parameter background: that name works too, and wins when both are given.
 */
imager
background(color bgcolor = 1;          /* colour of the background */
           color background = bgcolor; /* another name for it */
           )
{
  Ci += (1 - alpha) * background;
  Oi = 1;
  alpha = 1;
}

/* transitions.h: masks that go from 0 to 1 in more interesting ways than a ramp.
 *
 * After the appendix of "Shading a Coral Reef" (Bernardi, RenderMan, Theory and Practice, SIGGRAPH 2003 course 9). All masks are 0 to
 * 1; a blur or width of 0 makes an edge as sharp as the filter allows.
 */
#ifndef ANEMONE_TRANSITIONS_H
#define ANEMONE_TRANSITIONS_H

/* A step at center, blur wide: 0.5 at x = center. */
float blurstep(float center; float blur; float x) {
  float half_blur = max(blur, 1e-4) / 2;
  return smoothstep(center - half_blur, center + half_blur, x);
}

/* A ramp from 0 at low to 1 at high whose edge a pattern (0 to 1) moves by up to distort / 2 either way. */
float distortedramp(float low; float high; float x; float pattern; float distort) {
  return smoothstep(low, high, x + (pattern - 0.5) * distort);
}

/* A ramp that passes each place when it exceeds the pattern (0 to 1) there: the pattern is dissolved into the ramp, blur
 * wide. Where the ramp is 0 the mask is 0, where it is 1 the mask is 1, whatever the pattern.
 */
float patternramp(float low; float high; float x; float pattern; float blur) {
  float ramp = smoothstep(low, high, x);
  return blurstep(pattern, blur, ramp * (1 + blur) - blur / 2);
}

/* 1 from low to high, with soft ends of the given width inside. low <= 0 or high >= 1 leave that end of x = 0 to 1 open. */
float coverage(float low; float high; float width; float x) {
  float soft = max(width, 1e-4);
  float begins = low <= 0 ? 1 : smoothstep(low, low + soft, x);
  float ends = high >= 1 ? 1 : 1 - smoothstep(high - soft, high, x);
  return begins * ends;
}

#endif

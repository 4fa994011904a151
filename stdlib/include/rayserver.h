/* rayserver.h: for shaders of the days when PRMan asked BMRT for its rays. What the header defined then are built-in
 * functions here: trace, visibility, rayhittest, fulltrace, raylevel, isshadowray.
 */
#ifndef ANEMONE_RAYSERVER_H
#define ANEMONE_RAYSERVER_H
#endif

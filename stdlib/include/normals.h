/* normals.h: PRMan's header of shadingnormal(), which is a built-in function here.
 */
#ifndef ANEMONE_NORMALS_H
#define ANEMONE_NORMALS_H
#endif

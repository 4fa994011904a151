#ifndef OPEN_GUARD_H // expect-warning: the '#ifndef' on this line has no '#endif'; the end of the file ends it
#define OPEN_GUARD_H
float third(float x) { return x / 3; }

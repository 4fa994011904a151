// The types of the RenderMan Interface, for sources of plug-ins that include ri.h. Its functions are no
// business of functions for shaders; programs that make scenes use another header of this name. Strings are
// not const here: sources of plug-ins count on that.
#pragma once

#include <stddef.h>

typedef short RtBoolean;
typedef int RtInt;
typedef float RtFloat;
typedef char* RtToken;
typedef char* RtString;
typedef void* RtPointer;
typedef RtFloat RtColor[3];
typedef RtFloat RtPoint[3];
typedef RtFloat RtVector[3];
typedef RtFloat RtNormal[3];
typedef RtFloat RtHpoint[4];
typedef RtFloat RtMatrix[4][4];
typedef RtFloat RtBasis[4][4];
typedef RtFloat RtBound[6];
#define RtVoid void

#define RI_FALSE 0
#define RI_TRUE 1
#define RI_INFINITY ((RtFloat)1.0e38)
#define RI_EPSILON ((RtFloat)1.0e-10)
#ifndef RI_NULL
#define RI_NULL NULL
#endif
#ifndef RIE_NOERROR
#define RIE_NOERROR 0
#endif

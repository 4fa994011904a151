/* Lacks two of the functions of a plug-in. */
#include <ri.h>

RtVoid Free(RtPointer data) {
  (void)data;
}

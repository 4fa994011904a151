// What the preprocessor finds wrong.
#include "missing.h" // expect-error: cannot find 'missing.h'
#error this is wrong // expect-error: this is wrong
#define TWICE 1
#define TWICE 2 // expect-warning: redefinition
surface s() {}
/* this goes on to the end // expect-error: is never closed

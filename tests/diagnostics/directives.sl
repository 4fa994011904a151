// Directives of the preprocessor.
#includ "normals.h" // expect-error: there is no directive '#includ'; did you mean '#include'?
#import "normals.h" // expect-error: there is no directive '#import'
#include normals.h // expect-error: the name of an included file stands in quotes
#define // expect-error: ill formed preprocessor directive: #define
#if X > // expect-error: ill formed preprocessor expression
#endif
#else // expect-error: this '#else' has no '#if'
#ifdef NEVER
#for_others
#endif
#pragma
#define SUM(a, b) a + b
float few() { return SUM(1); } // expect-error: macro 'SUM' is called with too few arguments

// An #ifdef that nothing ends.
#ifdef NEVER // expect-error: the '#ifdef' on this line has no '#endif'
surface a() {
#if 1
#endif

// The same with too many of something.
#define SUM(a, b) a + b
#ifdef NEVER
#endif
#endif // expect-error: this '#endif' has no '#if'
float many() { return SUM(1, 2, 3); } // expect-error: macro 'SUM' is called with too many arguments

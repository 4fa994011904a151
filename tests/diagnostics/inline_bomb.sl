// Functions are expanded inline: their number multiplies.
float f0(float x) { return x; }
float f1(float x) { return f0(x) + f0(x) + f0(x) + f0(x) + f0(x) + f0(x) + f0(x) + f0(x); }
float f2(float x) { return f1(x) + f1(x) + f1(x) + f1(x) + f1(x) + f1(x) + f1(x) + f1(x); }
float f3(float x) { return f2(x) + f2(x) + f2(x) + f2(x) + f2(x) + f2(x) + f2(x) + f2(x); }
float f4(float x) { return f3(x) + f3(x) + f3(x) + f3(x) + f3(x) + f3(x) + f3(x) + f3(x); }
float f5(float x) { return f4(x) + f4(x) + f4(x) + f4(x) + f4(x) + f4(x) + f4(x) + f4(x); }
surface bomb() { Ci = f5(s); } // expect-error: expands to more than 20000 function calls

// Variables and loops in shaders of other kinds, and outside their loops.
light lamp(float k = 1) { Ci = k; Oi = 1; } // expect-error: 'Ci' does not exist in light shaders; lights set Cl and Ol // expect-error: 'Oi' does not exist in light shaders; lights set Cl and Ol
displacement dent(float k = 1) { Oi = k; P += N; } // expect-error: 'Oi' does not exist in displacement shaders; displacements set P and N
surface shining(float k = 1) { illuminate(P) { Cl = k; } } // expect-error: illuminate can be used in light shaders only; this is a surface shader // expect-error: 'Cl' is read-only in surface shaders
volume fog(float k = 1) { Ci = Cs * k; } // expect-error: 'Cs' does not exist in volume shaders
imager tint(float k = 1) { Ci = color N * k; } // expect-error: 'N' does not exist in imager shaders
light mirror(float k = 1) { illuminance(P) { Cl += k; } } // expect-error: illuminance cannot be used in light shaders
light counting(float k = 1) { Cl = k * diffuse(N); } // expect-error: 'diffuse' asks the lights and cannot be called by one
surface outside(float k = 1) {
  Ci = k * Cl; // expect-error: 'Cl' has a meaning only inside an illuminance loop
  vector l = normalize(L); // expect-error: 'L' has a meaning only inside an illuminance loop
  illuminance(P, N) Ci += Cl * length(l); // expect-error: illuminance takes ([category,] position [, axis, angle] [, token, value...])
  illuminance(P) { illuminance(P) { Ci += Cl; } } // expect-error: illuminance cannot stand inside illuminance
  Cs = 1; // expect-warning: 'Cs' is read-only in surface shaders: a copy is changed, which this shader alone sees
}
light pointing(point from = (0, 0, 0)) {
  illuminate(from) { Cl = 1 / (L . L); }
  Cl *= length(L); // expect-error: 'L' has a meaning only inside illuminate or solar
}
surface promises(uniform float k = s) { // expect-error: a varying value cannot be stored in the uniform variable 'k': declare it 'varying'
  uniform float x = noise(P); // expect-error: a varying value cannot be stored in the uniform variable 'x': declare it 'varying'
  string name = "a";
  if (s > 0.5) name = "b";
  Ci = photonmap(name, P) * k * x; // expect-error: 'file' of 'photonmap' must be uniform; this value is varying
}

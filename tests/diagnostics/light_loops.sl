// Kinds of shaders, their variables and their loops.
light wrong(float k = 1)
{
  Ci = k; // expect-error: 'Ci' does not exist in light shaders; lights set Cl and Ol
  Ps = P; // expect-warning: 'Ps' is read-only in light shaders
  Cl = length(L); // expect-error: only inside illuminate or solar
  Cl = diffuse(Ns); // expect-error: asks the lights and cannot be called by one
  illuminance(P) { Cl += 1; } // expect-error: illuminance cannot be used in light shaders
  illuminate(P) {
    solar() { Cl = 1; } // expect-error: solar cannot stand inside illuminate or solar
  }
}
surface also_wrong()
{
  float f = 0;
  Ci = Cl; // expect-error: 'Cl' has a meaning only inside an illuminance loop
  lightsource("intensity", f); // expect-error: 'lightsource' has a meaning only inside
  illuminate(P) { f += 1; } // expect-error: illuminate can be used in light shaders only
  illuminance(P) {
    illuminance(P) { f += 1; } // expect-error: illuminance cannot stand inside illuminance
    Ci += Cl * f;
  }
  Cs = 1; // expect-warning: 'Cs' is read-only in surface shaders
}
displacement bump() { P += Ci; } // expect-error: cannot take (point, color) // expect-error: 'Ci' does not exist in displacement shaders
imager over() { Ci += Cs; } // expect-error: 'Cs' does not exist in imager shaders

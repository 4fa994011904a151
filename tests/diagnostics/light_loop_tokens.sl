surface t(string which = "send:light:intensity") {
  illuminance (P, which, 2) Ci += Cl;  // expect-error: the name of an optional argument of 'illuminance' must be a constant
}

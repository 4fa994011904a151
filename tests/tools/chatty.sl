/* Prints, and reads outside an array: what becomes of both when a shader runs many times on several threads. */
surface chatty() {
  float a[2] = { 1, 2 };
  printf("hello\n");
  Ci = a[5 * u];
}

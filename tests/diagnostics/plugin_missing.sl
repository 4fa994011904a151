// A plug-in that is not there; the other messages about them have tests in tests/plugins.
plugin "nowhere"; // expect-error: cannot use the plug-in 'nowhere'
surface plugin_missing() {
  float plugin = 1; // a name like any other
  Ci = plugin;
}

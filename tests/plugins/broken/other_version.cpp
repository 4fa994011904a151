// Compiled with another version of the header.
extern "C" {
__attribute__((visibility("default"))) void* RslPublicFunctions[8];
extern __attribute__((visibility("default"))) const int anemone_rslplugin_interface;
const int anemone_rslplugin_interface = 77;
}

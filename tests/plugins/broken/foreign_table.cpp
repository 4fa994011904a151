// The table of another renderer's header.
extern "C" {
__attribute__((visibility("default"))) void* RslPublicFunctions[8];
}

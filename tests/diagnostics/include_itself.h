#include "include_itself.h" // expect-error: nested more than 64 deep

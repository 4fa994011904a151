// The way into the module: its functions, in a table.
#include "render/oiio/functions.h"
#include "render/texture/texture_image.h"

extern "C" void anemone_image_module(render::ImageModule* table) {
  using namespace render::oiio;
  *table = {"", open_texture, knows_format, write_image, read_depth};
}

// Image files through OpenImageIO: a module of its own, which image_module.cpp loads when such a file is to
// be written. The library and all it needs take longer to start than most test files take to run.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>
#include <string>

namespace {

OIIO::TypeDesc pixel_type(const std::string& path) {
  if (path.ends_with(".png") || path.ends_with(".jpg")) return OIIO::TypeDesc::UINT8;
  if (path.ends_with(".tif") || path.ends_with(".tiff")) return OIIO::TypeDesc::UINT16;
  return OIIO::TypeDesc::FLOAT;
}

std::string write_image(const std::string& path, const float* pixels, int nu, int nv, int channels) {
  std::unique_ptr<OIIO::ImageOutput> file = OIIO::ImageOutput::create(path);
  if (!file) return OIIO::geterror();
  OIIO::ImageSpec spec(nu, nv, channels, pixel_type(path));
  spec.attribute("oiio:ColorSpace", "Linear");
  if (!file->open(path, spec) || !file->write_image(OIIO::TypeDesc::FLOAT, pixels) || !file->close())
    return file->geterror();
  return "";
}

} // namespace

/// Writes row by row interleaved pixels. False: `error`, with room for `error_size` bytes, says why.
extern "C" bool sltest_write_image(const char* path, const float* pixels, int nu, int nv, int channels,
                                   char* error, size_t error_size) {
  const std::string text = write_image(path, pixels, nu, nv, channels);
  error[std::min(text.size(), error_size - 1)] = '\0';
  text.copy(error, error_size - 1);
  return text.empty();
}

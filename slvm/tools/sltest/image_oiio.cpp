// Image files through OpenImageIO: a module of its own, which image_module.cpp loads when such a file is to
// be written or read. The library and all it needs take longer to start than most test files take to run.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace {

OIIO::TypeDesc pixel_type(const std::string& path, bool small) {
  if (path.ends_with(".png") || path.ends_with(".jpg")) return OIIO::TypeDesc::UINT8;
  if (path.ends_with(".tif") || path.ends_with(".tiff")) return OIIO::TypeDesc::UINT16;
  return small ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
}

std::string write_image(const std::string& path, const std::string& temporary, const float* pixels, int nu,
                        int nv, int channels, bool small) {
  std::unique_ptr<OIIO::ImageOutput> file = OIIO::ImageOutput::create(path);
  if (!file) return OIIO::geterror();
  OIIO::ImageSpec spec(nu, nv, channels, pixel_type(path, small));
  spec.attribute("oiio:ColorSpace", "Linear");
  if (!file->open(temporary, spec) || !file->write_image(OIIO::TypeDesc::FLOAT, pixels) || !file->close())
    return file->geterror();
  return "";
}

std::string read_image(const std::string& path, int* shape, float* pixels, size_t room, float* others,
                       size_t count) {
  std::unique_ptr<OIIO::ImageInput> file = OIIO::ImageInput::open(path);
  if (!file) return OIIO::geterror();
  const OIIO::ImageSpec& spec = file->spec();
  shape[0] = spec.width;
  shape[1] = spec.height;
  shape[2] = spec.nchannels;
  if (room < spec.image_pixels() * static_cast<size_t>(spec.nchannels)) return ""; // only its size is wanted
  if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels)) return file->geterror();
  std::vector<char> stored(count * spec.format.size());
  const int n = static_cast<int>(count);
  if (!OIIO::convert_pixel_values(OIIO::TypeDesc::FLOAT, others, spec.format, stored.data(), n) ||
      !OIIO::convert_pixel_values(spec.format, stored.data(), OIIO::TypeDesc::FLOAT, others, n))
    return "pixels of an unknown kind";
  return "";
}

bool report(const std::string& text, char* error, size_t error_size) {
  const size_t length = text.copy(error, error_size - 1);
  error[length] = '\0';
  return text.empty();
}

} // namespace

/// Writes row by row interleaved pixels to `temporary`, in the format that `path` asks for. False: `error`,
/// with room for `error_size` bytes, says why.
extern "C" bool sltest_write_image(const char* path, const char* temporary, const float* pixels, int nu,
                                   int nv, int channels, bool small, char* error, size_t error_size) {
  return report(write_image(path, temporary, pixels, nu, nv, channels, small), error, error_size);
}

/// Reads width, height and channels to `shape`, and the pixels where there is room for them. `others` become
/// what the file's kind of numbers makes of them.
extern "C" bool sltest_read_image(const char* path, int* shape, float* pixels, size_t room, float* others,
                                  size_t count, char* error, size_t error_size) {
  return report(read_image(path, shape, pixels, room, others, count), error, error_size);
}

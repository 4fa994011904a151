// Image files through OpenImageIO.
#include "slvm/tools/sltest/image.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

namespace slvm::sltest {

Result<bool> write_image(const std::string& path, const std::vector<float>& pixels, int nu, int nv,
                         int channels) {
  std::unique_ptr<OIIO::ImageOutput> file = OIIO::ImageOutput::create(path);
  if (!file) return Error{fmt::format("{}: {}", path, OIIO::geterror())};
  OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT;
  if (path.ends_with(".png") || path.ends_with(".jpg")) type = OIIO::TypeDesc::UINT8;
  if (path.ends_with(".tif") || path.ends_with(".tiff")) type = OIIO::TypeDesc::UINT16;
  OIIO::ImageSpec spec(nu, nv, channels, type);
  spec.attribute("oiio:ColorSpace", "Linear");
  if (!file->open(path, spec) || !file->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) || !file->close())
    return Error{fmt::format("{}: {}", path, file->geterror())};
  return true;
}

} // namespace slvm::sltest

// Builds without OpenImageIO write .pfm, .csv and .txt only.
#include "slvm/tools/sltest/image.h"

#include <fmt/format.h>

namespace slvm::sltest {

Result<bool> write_image(const std::string& path, const std::vector<float>&, int, int, int) {
  return Error{
      fmt::format("{}: this build writes .pfm, .csv and .txt only (it is without OpenImageIO)", path)};
}

} // namespace slvm::sltest

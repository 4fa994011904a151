// Pictures compared with ones that were looked at. With ANEMONE_UPDATE_GOLDEN set they are written anew: look
// at them before they are committed.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace anemone::test {

/// How much of a difference passes: of the whole picture, and of its worst pixel.
struct PictureTolerance {
  double rms = 0.004; ///< halves keep three digits; pictures differ a little between instruction sets
  double worst = 0.08;
};

/// Compares the picture `file` with `golden`, half floats, and reports where they differ most.
inline void expect_golden(const std::string& file, const std::string& golden,
                          PictureTolerance tolerance = {}) {
  OIIO::ImageBuf now(file);
  ASSERT_TRUE(now.read(0, 0, true, OIIO::TypeDesc::FLOAT)) << now.geterror();
  if (std::getenv("ANEMONE_UPDATE_GOLDEN")) {
    OIIO::ImageSpec spec = now.spec();
    spec.attribute("compression", "zip");
    spec.erase_attribute("Software");
    OIIO::ImageBuf copy(spec);
    OIIO::ImageBufAlgo::copy(copy, now, OIIO::TypeDesc::FLOAT);
    copy.specmod().attribute("compression", "zip");
    ASSERT_TRUE(copy.write(golden, OIIO::TypeDesc::HALF)) << copy.geterror();
  }
  OIIO::ImageBuf kept(golden);
  ASSERT_TRUE(kept.read(0, 0, true, OIIO::TypeDesc::FLOAT)) << golden << ": " << kept.geterror();
  auto difference = OIIO::ImageBufAlgo::compare(now, kept, 0.05f, 0.02f);
  EXPECT_LT(difference.rms_error, tolerance.rms) << golden;
  EXPECT_LT(difference.maxerror, tolerance.worst)
      << golden << ": pixel " << difference.maxx << " " << difference.maxy << " channel " << difference.maxc;
}

} // namespace anemone::test

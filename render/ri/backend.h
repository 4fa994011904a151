// What a context of the C interface does with its requests: renders them, or writes them to a file.
#pragma once

#include "render/ri/ri.h"
#include "render/ri/size_tracker.h"
#include "render/rib/ri_error.h"
#include "render/rib/ri_target.h"
#include "render/state/math.h"
#include "render/state/procedural.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace render::ri {

/// Takes messages: kind, RIE_INFO to RIE_SEVERE, text.
using Report = std::function<void(RiError, RtInt severity, const std::string&)>;

class Backend {
public:
  virtual ~Backend() = default;
  /// Messages that arise go to this from now on.
  void set_report(Report report) { report_ = std::move(report); }

  virtual void request(const RequestCall& call) = 0;
  /// Of RiArchiveRecord; without the first #.
  virtual void comment(const std::string& text) = 0;
  virtual void verbatim(const std::string& rib) = 0;
  /// ReadArchive. `on_comment` hears of the file's comments (without the first #) where it is read here.
  virtual void read_archive(const RequestCall& call,
                            const std::function<void(std::string_view)>& on_comment) = 0;
  virtual void procedural(std::span<const float, 6> bound, std::shared_ptr<GeometryMaker> maker,
                          slvm::SourceRange where) = 0;
  /// PixelFilter with a function of the program's own.
  virtual void pixel_filter(RtFilterFunc function, RtFloat xwidth, RtFloat ywidth) = 0;
  /// From a space to camera space. An error: it is not known, or this is no place to ask.
  virtual slvm::Result<Matrix4> to_camera(const std::string& space) = 0;
  /// Refreshes what `tracker` cannot have seen, when requests did not come from the program.
  virtual void update(SizeTracker& /*tracker*/) {}
  /// The program has chosen another handler.
  virtual void error_handler(RtErrorHandler /*handler*/) {}
  /// No more requests follow.
  virtual void finish() = 0;
  /// Nothing of it is to be kept.
  virtual void abandon() {}

protected:
  void report(RiError kind, RtInt severity, const std::string& text) const {
    if (report_) report_(kind, severity, text);
  }

private:
  Report report_;
};

/// How and where a file is written.
struct RibOutput {
  std::string file;
  bool binary = false, gzip = false;
  int precision = 0; ///< significant digits; 0: as many as it takes
};

} // namespace render::ri

// A context that writes RIB.
#pragma once

#include "render/ri/backend.h"
#include "render/rib/rib_file.h"
#include "render/rib/writer.h"

#include <vector>

namespace render::ri {

class RibBackend : public Backend {
public:
  /// The file is made at the first request; until then Option "rib" can change its form.
  explicit RibBackend(RibOutput output) : output_(std::move(output)) {}

  void request(const RequestCall& call) override;
  void comment(const std::string& text) override;
  void verbatim(const std::string& rib) override;
  void read_archive(const RequestCall& call, const std::function<void(std::string_view)>&) override {
    request(call);
  }
  /// A file cannot keep a function: what it makes of a bound that fills the picture is written here.
  void procedural(std::span<const float, 6> bound, std::shared_ptr<GeometryMaker> maker,
                  slvm::SourceRange where) override;
  void pixel_filter(RtFilterFunc function, RtFloat xwidth, RtFloat ywidth) override;
  slvm::Result<Matrix4> to_camera(const std::string& space) override;
  void error_handler(RtErrorHandler handler) override;
  void finish() override;
  void abandon() override { file_.reset(); }

private:
  bool open();
  bool nests(const RequestCall& call);
  bool legal(const RequestCall& call);
  void error(const RequestCall& call, RiError kind, std::string_view text);

  RibOutput output_;
  std::unique_ptr<RibFile> file_;
  std::unique_ptr<RibWriter> writer_;
  bool failed_ = false;
  std::vector<RequestId> blocks_; ///< ...Begin of those that are open
  int functions_ = 0;             ///< procedurals that are being carried out
  size_t functions_called_ = 0;   ///< within the outermost of them
};

/// Reads Option "rib" into `output`. Empty, or what is wrong.
std::string set_rib_option(const RequestCall& call, RibOutput& output);

} // namespace render::ri

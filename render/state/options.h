// Everything that is fixed for a frame at WorldBegin: camera, image, sampling, outputs. Plain data with the
// defaults of the RISpec (3.2, tables 4.1 to 4.4).
#pragma once

#include "render/state/math.h"
#include "render/state/shader_request.h"
#include "render/texture/filter_kind.h"
#include "slvm/value.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace render {

enum class ProjectionKind : uint8_t { kOrthographic, kPerspective };

struct PixelFilter {
  FilterKind kind = FilterKind::kGaussian;
  float xwidth = 2, ywidth = 2;
  bool operator==(const PixelFilter&) const = default;
  /// Of kFunction: the weight at (x, y) from the centre, given the two widths. Called from many threads.
  float (*function)(float x, float y, float xwidth, float ywidth) = nullptr;
};

/// What is on the side its normal points to is not drawn. Camera space.
struct ClippingPlane {
  Vec3 point, normal;
  bool hides(Vec3 p) const { return glm::dot(p - point, normal) > 0; }
};

/// Which depth a pixel of a z image gets: of its own samples the nearest, the farthest, their mean, or the
/// nearest middle between the first two surfaces (Woo, 1992).
enum class DepthFilter : uint8_t { kMin, kMax, kAverage, kMidpoint };

/// Hider "depthmask": what is in front of a depth image (or behind it) is left out.
struct DepthMaskRequest {
  std::string file;
  bool reverse = false; ///< leave out what is behind
  float bias = 0.01f;
  slvm::SourceRange where;
};

struct Quantization {
  int one = 255, min = 0, max = 255;
  float dither = 0.5f;
  bool set = false; ///< by a request, not by default
  int zero = 0;     ///< what 0 becomes
  /// No quantisation at all.
  bool is_float() const { return one == zero; }
};

/// One DisplayChannel request.
struct ChannelRequest {
  std::string declaration; ///< "varying color name"
  std::map<std::string, slvm::Value> params;
  slvm::SourceRange where;
};

/// One Display request.
struct DisplayRequest {
  std::string name, type, mode;
  std::map<std::string, slvm::Value> params;
  slvm::SourceRange where;
};

struct Options {
  // camera
  int xres = 640, yres = 480;
  float pixel_aspect = 1;
  std::optional<float> frame_aspect;
  std::optional<std::array<float, 4>> screen_window; ///< left right bottom top
  std::array<float, 4> crop{0, 1, 0, 1};             ///< xmin xmax ymin ymax, NDC
  ProjectionKind projection = ProjectionKind::kOrthographic;
  float fov = 90;
  float near_plane = 0.01f, far_plane = 1e30f;
  std::vector<ClippingPlane> clipping_planes;
  /// The lens is focal_length / fstop wide; a pinhole by default.
  float fstop = kInfinity, focal_length = 0, focal_distance = kInfinity;
  float shutter_open = 0, shutter_close = 0, shutter_offset = 0;
  /// The transformation in force at Projection: acts after the projection, on the image plane.
  Matrix4 screen_transform;
  float relative_detail = 1;

  // sampling and image
  int xsamples = 2, ysamples = 2;
  bool jitter = true;
  bool subpixel = false;     ///< a pixel of the image for each sample
  bool sample_motion = true; ///< false: what moves is drawn where it is when the shutter opens
  size_t photons = 0;        ///< Hider "photon": so many are emitted, instead of an image; 0: an image
  bool no_image = false;     ///< Hider "null": nothing is rendered
  DepthFilter depth_filter = DepthFilter::kMin;
  std::optional<DepthMaskRequest> depth_mask;
  PixelFilter filter;
  float gain = 1, gamma = 1;
  Quantization rgba;
  Quantization z{0, 0, 0, 0, false};
  std::map<std::string, Quantization> channel_quantization; ///< of other channels, by name
  std::vector<DisplayRequest> displays;
  std::map<std::string, ChannelRequest> channels; ///< by name
  std::shared_ptr<const ShaderRequest> imager;

  // limits
  int bucket_width = 32, bucket_height = 32;
  int grid_size = 512; ///< micropolygons in a grid, at most
  int eye_splits = 10;
  int threads = 0; ///< 0: not said
  float texture_megabytes = 1024;
  float octree_megabytes = 256;    ///< of lit clouds of points
  Color opacity_threshold{0.996f}; ///< opacity at which a sample counts as closed
  Color depth_threshold{1.0f};     ///< opacity at which a surface shows in z images

  /// "shader", "archive", ... : the directories in order.
  std::map<std::string, std::vector<std::string>> search_paths;
  /// Whatever else option() can ask for, by "category:parameter".
  std::map<std::string, slvm::Value> named;
  int frame = 0;

  /// xres * pixelaspect / yres unless FrameAspectRatio says otherwise.
  float aspect() const;
  /// Given, or the default for the aspect: the shorter side spans -1 to 1.
  std::array<float, 4> window() const;
};

} // namespace render

// Everything that is fixed for a frame at WorldBegin: camera, image, sampling, outputs. Plain data with the
// defaults of the RISpec (3.2, tables 4.1 to 4.4).
#pragma once

#include "render/state/math.h"
#include "render/state/shader_request.h"
#include "slvm/value.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace render {

enum class ProjectionKind : uint8_t { kOrthographic, kPerspective };
enum class FilterKind : uint8_t { kBox, kTriangle, kGaussian, kCatmullRom, kBSpline, kSinc, kMitchell };

struct PixelFilter {
  FilterKind kind = FilterKind::kGaussian;
  float xwidth = 2, ywidth = 2;
};

struct Quantization {
  int one = 255, min = 0, max = 255;
  float dither = 0.5f;
  bool set = false; ///< by a request, not by default
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
  float shutter_open = 0, shutter_close = 0, shutter_offset = 0;
  /// The transformation in force at Projection: acts after the projection, on the image plane.
  Matrix4 screen_transform;

  // sampling and image
  int xsamples = 2, ysamples = 2;
  bool jitter = true;
  PixelFilter filter;
  float gain = 1, gamma = 1;
  Quantization rgba;
  Quantization z{0, 0, 0, 0, false};
  std::vector<DisplayRequest> displays;
  std::shared_ptr<const ShaderRequest> imager;

  // limits
  int bucket_width = 32, bucket_height = 32;
  int grid_size = 256; ///< micropolygons in a grid, at most
  int eye_splits = 10;
  Color opacity_threshold{0.996f}; ///< opacity at which a sample counts as closed

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

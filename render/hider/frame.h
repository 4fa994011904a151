// One frame: splits all primitives, hides bucket by bucket on all processors, shades each visible grid once,
// returns the finished pixels. Read after prims/split.h, prims/dice.h, hider/sample_buffer.h.
#pragma once

#include "render/hider/depth_mask.h"
#include "render/hider/frame_report.h"
#include "render/hider/image.h"
#include "render/hider/task_batch.h"
#include "render/shading/grid_shader.h"
#include "render/state/scene.h"

#include <functional>
#include <vector>

namespace render {

struct FrameSettings {
  int threads = 0; ///< 0: all processors
  std::vector<AovChannel> aovs;
  Image::StandardChannels shown = Image::all(); ///< the image has these
  const DepthMask* mask = nullptr;              ///< of Hider "depthmask"
  /// Who makes what procedurals hold. Null: scenes have none.
  ContentMaker make_content;
  /// Called with the finished fraction, from any thread but never from two at once.
  std::function<void(double)> progress;
  /// Called with the pixels of a bucket when they are finished, imager included; from several threads at
  /// once.
  std::function<void(const Image&, const PixelRect&)> finished;
};

/// The threads that FrameSettings::threads stands for.
int thread_count(int threads);

/// The same pixels, to the last bit, for any number of threads.
Image render_frame(const Scene& scene, Shading& shading, const FrameSettings& settings, FrameReport& report);

} // namespace render

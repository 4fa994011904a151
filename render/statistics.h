// What a frame cost: counts, times, memory; as text for people and as JSON for tools.
#pragma once

#include "render/hider/frame.h"
#include "render/rays/ray_usage.h"

#include <string>

namespace render {

struct FrameStatistics {
  static constexpr int kVersion = 1; ///< of the JSON form

  int frame = 0;          ///< of FrameBegin
  bool asked_for = false; ///< by Option "statistics" "endofframe"
  int width = 0, height = 0, samples_per_pixel = 0, threads = 0;
  FrameReport report;
  double bind_seconds = 0, render_seconds = 0, write_seconds = 0;
  RayUsage rays;
  long long texture_files = 0, texture_bytes = 0; ///< files read, memory of their tiles
  long long peak_bytes = 0;                       ///< most memory the process had so far
};

std::string format_text(const FrameStatistics&);
/// One object, without line ends inside.
std::string format_json(const FrameStatistics&);

/// The most memory the process had so far.
long long peak_memory();

} // namespace render

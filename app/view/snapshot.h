// Pictures of both eyes as files, `name_left.png` and `name_right.png`: claimed before the work, whole or not there.
// Any thread; milliseconds.
#pragma once

#include <string>

#include "calibration/output_file.h"
#include "render/frame_renderer.h"
#include "render/image.h"

namespace app {

/// Under the first free of `molar-snapshot-1.png`, …; its name.
std::string saveNextSnapshot(const render::Image& picture);

void savePng(const render::Image& picture, calibration::OutputFile& file);

class StereoSnapshot {
 public:
  /// Refuses (CalibrationError) what is there already, unless `overwrite`.
  StereoSnapshot(const std::string& path, bool overwrite);
  void save(const render::Image& left, const render::Image& right);
  /// Draws both eyes of the frame and saves them.
  void take(render::FrameRenderer& renderer, const render::Frame& frame);

 private:
  calibration::OutputFile left_, right_;
};

}  // namespace app

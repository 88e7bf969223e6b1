// PNG files of the view: both eyes (`name_left.png`, `name_right.png`), claimed before the work and written whole or
// not at all, or one picture. Any thread; milliseconds.
#pragma once

#include <string>

#include "calibration/output_file.h"
#include "render/frame_renderer.h"
#include "render/image.h"

namespace app {

/// Throws CalibrationError.
void savePng(const render::Image& image, calibration::OutputFile& file);

class StereoSnapshot {
 public:
  /// Throws CalibrationError if a file exists, unless `overwrite`.
  StereoSnapshot(const std::string& path, bool overwrite);
  /// Draws both eyes of the frame and saves them.
  void take(render::FrameRenderer& renderer, const render::Frame& frame);

 private:
  calibration::OutputFile left_, right_;
};

}  // namespace app

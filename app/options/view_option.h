// Options of the point of view: `--rig RIG --eye left/right/cyclopean`, or `--camera JSON` (text or file), and
// `--size WxH`. Default: a camera looking at the middle of the volume. Start-up only.
#pragma once

#include <string>

#include "app/station/rig_choice.h"
#include "assets/volume_grid.h"
#include "calibration/rig.h"
#include "render/display/eye_projection.h"

namespace app {

class CommandLine;

/// "640x480", each 16 to 16384. Throws UsageError.
glm::ivec2 imageSize(const std::string& text);

class ViewOption {
 public:
  void addTo(CommandLine& command);
  /// A rig by name, not by file, has no patient pose.
  bool namesRig() const { return rig_.isName(); }
  /// Sets `rig`, with the image as its screen, and returns the eye.
  render::Eye apply(calibration::Rig& rig, const assets::VolumeGrid& grid) const;

 private:
  RigOption rig_;
  std::string eye_, camera_, size_;
};

}  // namespace app

// Options of the stereo display: `--display MODE`, `--swap-eyes`. Start-up only.
#pragma once

#include "calibration/rig.h"
#include "render/display/display_mode.h"

namespace app {

class CommandLine;

class DisplayOption {
 public:
  void addTo(CommandLine& command);
  render::DisplayMode mode() const { return mode_; }
  bool swapped() const { return swapped_; }
  /// Throws UsageError if the mode does not fit the rig's screen.
  void refuseUnlessFits(const calibration::Rig& rig) const;

 private:
  render::DisplayMode mode_ = render::DisplayMode::mono;
  bool swapped_ = false;
};

}  // namespace app

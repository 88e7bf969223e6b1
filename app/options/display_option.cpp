#include "app/options/display_option.h"

#include "app/text/command_line.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "render/display/stereo_layout.h"

namespace app {

void DisplayOption::addTo(CommandLine& command) {
  const std::string names = joined(render::kDisplayModes, &render::DisplayModeName::name);
  command
      .option(
          "--display",
          [this, names](const std::string& name) {
            const auto mode = render::displayModeNamed(name);
            if (!mode) throw UsageError("--display " + name + ": not a display, choose one of " + names);
            mode_ = *mode;
          },
          "Stereo display: " + names + " [mono]")
      .valueNamed("MODE");
  command.flag("--swap-eyes", swapped_, "The display shows left for right: exchange them");
}

void DisplayOption::refuseUnlessFits(const calibration::Rig& rig) const {
  const glm::ivec2 px = rig.screen.px;
  if (mode_ == render::DisplayMode::frame_packing && !render::isPackable(px))
    throw UsageError("--display frame-packing: HDMI packs 1920x1080 or 1280x720, the screen has " +
                     std::to_string(px.x) + "x" + std::to_string(px.y) + "; give --size or correct the rig");
}

}  // namespace app

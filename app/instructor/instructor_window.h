// The instructor's window, on the monitor after the surgeon's, or next to the view on the same one: the surgeon's
// image, composed once more, the panoramic view, and the panel. Redrawn at most ten times a second without waiting for
// its monitor's refresh, so the surgeon's frames are not delayed. Shares the surgeon's OpenGL context and is reopened
// after a reset of the graphics card. Empty where the surgeon has no window. Main thread; after every call the
// surgeon's context is current.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/controls/control.h"
#include "app/instructor/rehearsal_status.h"
#include "app/text/message.h"
#include "app/view/panoramic_picture.h"
#include "app/view/surgeon_display.h"
#include "calibration/rig.h"

namespace app {

class InstructorWindow {
 public:
  /// `after_monitor`: index of the surgeon's. Borrows display and rig; `report` receives why it cannot be opened.
  InstructorWindow(SurgeonDisplay& display, const calibration::Rig& rig, int after_monitor, ReportLine report);
  ~InstructorWindow();

  /// The view shown below the surgeon's image, with the bur in it.
  void setPanoramic(std::optional<PanoramicPicture> panoramic) { panoramic_ = std::move(panoramic); }

  bool isDue() const;
  /// Keys have the same meaning as in the surgeon's window, but for Esc: it closes a list of the panel.
  struct Input {
    std::vector<ControlRequest> requests;
    std::vector<render::WindowEvent> keys;
  };
  /// Draws image and panel. Returns the input since the last drawing.
  Input draw(const RehearsalStatus& status);
  void reopenAfterReset();

 private:
  struct Open;

  void open();
  void showPanoramic(glm::ivec2 window_px, const glm::dvec3& bur_P_mm);

  SurgeonDisplay& display_;
  const calibration::Rig& rig_;
  int after_monitor_;
  ReportLine report_;
  std::unique_ptr<Open> open_;
  std::optional<PanoramicPicture> panoramic_;
  int context_losses_ = 0;
};

}  // namespace app

// The place beside the surgeon: opens the instructor's window on the next monitor, or beside the picture on the same,
// draws it ten times a second while the surgeon's picture is on its way, opens it again after the graphics card was
// reset. Empty where there is no window. Main thread; afterwards the surgeon's context is current.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "app/instructor/instructor_window.h"
#include "app/view/surgeon_display.h"
#include "calibration/rig.h"

namespace app {

class InstructorDisplay {
 public:
  /// `after_monitor`: index of the surgeon's. Borrows both; `report` says why it can not be had.
  InstructorDisplay(SurgeonDisplay& display, const calibration::Rig& rig, int after_monitor,
                    std::function<void(const std::string&)> report);

  bool isDue() const { return window_ && window_->isDue(); }
  /// What the instructor requests now; `keys` are pressed in this window and mean what they mean in the surgeon's.
  struct Input {
    std::vector<ControlRequest> requests;
    std::vector<render::WindowEvent> keys;
  };
  Input serve(const RehearsalStatus& status);
  /// Opens again what a reset closed.
  void reopenAfterReset();

 private:
  void open();

  SurgeonDisplay& display_;
  const calibration::Rig& rig_;
  int after_monitor_;
  std::function<void(const std::string&)> report_;
  std::optional<InstructorWindow> window_;
  int context_losses_ = 0;
};

}  // namespace app

// The instructor's window, on a second monitor where there is one: what the surgeon sees, without drawing it a second
// time, and the panel beside it. Nothing of it is in the surgeon's view. At most ten times a second and never waiting
// for its monitor, so the surgeon's pictures are not held up. Dear ImGui draws it, fed from the window's events. Main
// thread; after draw() this window's context is current.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "app/instructor/instructor_panel.h"
#include "render/display/window.h"
#include "render/frame_renderer.h"
#include "render/gpu/frame_fence.h"

namespace app {

class InstructorWindow {
 public:
  /// Shares pictures with the surgeon's window, which must outlive it. Throws GpuError.
  InstructorWindow(const render::Window& surgeons, std::optional<int> monitor);
  ~InstructorWindow();

  bool isDue() const;
  /// The renderer's picture for bystanders must be composed; `composed` marks when. `seen`: its size, and whether a
  /// mirror turns it.
  struct SurgeonImage {
    glm::ivec2 px{0};
    bool flipped_x = false, flipped_y = false;
  };
  std::vector<ControlRequest> draw(const RehearsalStatus& status, render::FrameRenderer& renderer,
                                   const render::FrameFence& composed, const SurgeonImage& seen);
  /// Keys pressed in this window mean what they mean in the surgeon's. Closing it is asked by CloseRequested.
  std::vector<render::WindowEvent> takeKeys();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app

// The window of the check page, and of what goes before it: pages drawn on the CPU at its own size. Main thread.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "app/text/message.h"
#include "render/display/window.h"
#include "render/image.h"

namespace app {

class CheckWindow {
 public:
  /// Draws a page for that size.
  using Page = std::function<render::Image(glm::ivec2 window_px)>;

  /// Throws GpuError where no window can be opened.
  CheckWindow(const std::string& title, const ReportLine& report);
  ~CheckWindow();
  CheckWindow(const CheckWindow&) = delete;
  CheckWindow& operator=(const CheckWindow&) = delete;

  void setTitle(const std::string& title);
  glm::ivec2 size_px();
  std::vector<render::WindowEvent> takeEvents();
  /// Waits for the display.
  void show(const Page& page);

 private:
  struct Open;
  std::unique_ptr<Open> open_;
};

}  // namespace app

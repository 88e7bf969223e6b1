#include "app/check_page/check_window.h"

#include "app/view/display_windows.h"
#include "app/view/page_screen.h"

namespace app {
namespace {

constexpr glm::ivec2 kCheckWindow_px{1280, 800};

}  // namespace

struct CheckWindow::Open {
  explicit Open(const ReportLine& report) : windows({.screen_px = kCheckWindow_px}, report) {}
  DisplayWindows windows;
  PageScreen screen{windows, kCheckWindow_px, false};
};

CheckWindow::CheckWindow(const std::string& title, const ReportLine& report) : open_(std::make_unique<Open>(report)) {
  setTitle(title);
}
CheckWindow::~CheckWindow() = default;

void CheckWindow::setTitle(const std::string& title) { open_->windows.first().setTitle(title); }

glm::ivec2 CheckWindow::size_px() { return open_->windows.first().framebufferSize_px(); }

std::vector<render::WindowEvent> CheckWindow::takeEvents() { return open_->windows.takeEvents(); }

void CheckWindow::show(const Page& page) {
  open_->screen.show([&page](const render::StereoLayout& layout) { return page(layout.screen_px); });
}

}  // namespace app

#include "app/view/page_screen.h"

namespace app {

void PageScreen::show(const std::function<render::Image(const render::StereoLayout&)>& draw, bool as_the_panel) {
  const glm::ivec2 window_px = windows_.first().framebufferSize_px();
  if (window_px.x <= 0 || window_px.y <= 0) return;
  render::StereoLayout layout{.mode = windows_.mode(), .screen_px = screen_px_, .at_px = {0, 0}, .swapped = swapped_};
  if (!as_the_panel && render::outputSize(layout.mode, window_px) == window_px) layout.screen_px = window_px;
  if (render::isInterleaved(layout.mode)) layout.at_px = windows_.first().positionOnPanel_px();
  std::vector<render::Image> outputs;
  for (layout.output = 0; layout.output < render::outputCount(layout.mode); ++layout.output)
    outputs.push_back(draw(layout));
  windows_.fill([&](const render::WindowTarget& place, int output) {
    upload_[output].show(outputs[static_cast<std::size_t>(output)], place);
  });
  windows_.first().present();
}

}  // namespace app

#include "app/calibrate/wizard_pages.h"

#include <cassert>
#include <cmath>

#include "app/calibrate/page_text.h"
#include "app/report/stereo_picture.h"
#include "calibration/geometry/units.h"

namespace app {
namespace {

using render::Eye;
using render::Image;

constexpr double kPulse_s = 1.2;

bool areSame(const calibration::ScreenCorners& a, const calibration::ScreenCorners& b) {
  return a.lower_left.mm == b.lower_left.mm && a.lower_right.mm == b.lower_right.mm &&
         a.upper_left.mm == b.upper_left.mm;
}

}  // namespace

calibration::Rig WizardPages::rigOf(const WizardView& view) const {
  calibration::Rig rig;
  rig.mirror = mirror_;
  rig.screen = view.screen;
  rig.left_eye = view.left_eye;
  rig.right_eye = view.right_eye;
  return rig;
}

void WizardPages::prepare(const WizardView& view, glm::ivec2 px) {
  const calibration::Rig rig = rigOf(view);
  const bool fits = words_ && px == px_ && areSame(rig.screen, rig_.screen) && rig.left_eye.mm == rig_.left_eye.mm &&
                    rig.right_eye.mm == rig_.right_eye.mm;
  if (!fits) {
    rig_ = rig;
    px_ = px;
    words_ = std::make_unique<ScreenPage>(rig, px);
    eye_ = std::make_unique<ScreenPage>(rig, px);
    drawn_words_.clear();
  }
  std::string words = textOf(view);
  if (words == drawn_words_) return;
  drawText(*words_, view);
  drawn_words_ = std::move(words);
}

Image WizardPages::page(const WizardView& view, const std::optional<TrueStylus>& stylus, Eye eye, glm::ivec2 px,
                        double t_s) {
  prepare(view, px);
  eye_->copy(*words_);
  const double glow = 0.5 - 0.5 * std::cos(2.0 * calibration::kPi * t_s / kPulse_s);
  drawScene(*eye_, rig_, eye, view, stylus, glow);
  return eye_->picture();
}

Image WizardPages::output(const WizardView& view, const std::optional<TrueStylus>& stylus,
                          const render::StereoLayout& layout, double t_s) {
  const glm::ivec2 px = render::eyeImageSize(layout.mode, layout.screen_px);
  if (layout.mode == render::DisplayMode::mono) return page(view, stylus, Eye::cyclopean, px, t_s);
  if (render::outputCount(layout.mode) > 1)
    return page(view, stylus, (layout.output == 1) != layout.swapped ? Eye::right : Eye::left, px, t_s);
  const Image left = page(view, stylus, Eye::left, px, t_s);
  return stereoPicture(left, page(view, stylus, Eye::right, px, t_s), layout);
}

Image patternForCamera(const calibration::GreyImage& pattern, const render::StereoLayout& layout) {
  assert(pattern.size_px == layout.screen_px);
  const glm::ivec2 px = render::eyeImageSize(layout.mode, layout.screen_px);
  // Of a halved display each eye has every second row or column.
  const glm::ivec2 step{layout.screen_px.x / px.x, layout.screen_px.y / px.y};
  Image eye{px.x, px.y, {}};
  eye.rgba.reserve(4 * static_cast<std::size_t>(px.x) * static_cast<std::size_t>(px.y));
  for (int y = 0; y < px.y; ++y)
    for (int x = 0; x < px.x; ++x) {
      const std::uint8_t grey =
          pattern.grey[static_cast<std::size_t>(y * step.y) * static_cast<std::size_t>(pattern.size_px.x) +
                       static_cast<std::size_t>(x * step.x)];
      eye.rgba.insert(eye.rgba.end(), {grey, grey, grey, 255});
    }
  return layout.mode == render::DisplayMode::mono ? eye : stereoPicture(eye, eye, layout);
}

}  // namespace app

#include "app/view/panoramic_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "app/case/arch_curve.h"
#include "app/report/drawing.h"
#include "app/view/film_marks.h"

namespace app {
namespace {

constexpr double kPixel_mm = 0.25;
constexpr double kShortest_px = 0.2;  ///< piece of the canal whose direction in the image is known
/// The layer averages bone with soft tissue and air: a window below that of the slices. HU.
constexpr float kLowest_HU = -500.0f, kHighest_HU = 1300.0f;
constexpr Ink kCanal = inkOf(0xfacd3c), kBur = inkOf(0x5ae1ff);

render::Image greyImage(const assets::Panoramic& view) {
  render::Image image{view.size_px.x, view.size_px.y, {}};
  image.rgba.reserve(4 * view.hounsfield.size());
  for (const float hu : view.hounsfield) {
    const float shown = std::clamp((hu - kLowest_HU) / (kHighest_HU - kLowest_HU), 0.0f, 1.0f);
    const auto grey = static_cast<std::uint8_t>(255.0f * shown + 0.5f);
    image.rgba.insert(image.rgba.end(), {grey, grey, grey, 255});
  }
  return image;
}

}  // namespace

std::optional<PanoramicPicture> PanoramicPicture::of(const assets::Patient& patient) {
  const std::vector<glm::dvec2> curve = archCurve_P_mm(patient);
  if (curve.size() < 2) return std::nullopt;
  return PanoramicPicture(patient, assets::panoramicOf(patient.ct, curve, kPixel_mm));
}

PanoramicPicture::PanoramicPicture(const assets::Patient& patient, assets::Panoramic view)
    : view_(std::move(view)), grey_(greyImage(view_)), canal_radius_mm_(patient.mandibular_canal_radius_mm) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const glm::dvec3& p : patient.mandibular_canal_P_mm) {
    const auto at = view_.positionOf(p);
    canal_px_.push_back(at && at->from_curve_mm < 0.5 * assets::kPanoramicLayer_mm ? at->px : glm::dvec2(kNone));
  }
}

render::Image PanoramicPicture::image(double zoom, const std::optional<glm::dvec3>& bur_P_mm) const {
  const glm::dvec2 size{size_px(zoom)};
  const Drawing drawing(size_px(zoom), 1.0);
  drawing.image(grey_, {0.0, 0.0}, size);

  // The walls of the canal, on both sides of its centre line.
  const double wall_px = zoom * canal_radius_mm_ / view_.pixel_mm;
  for (const double side : {-1.0, 1.0}) {
    std::vector<glm::dvec2> wall;
    for (std::size_t n = 0; n + 1 < canal_px_.size(); ++n) {
      const glm::dvec2 along = canal_px_[n + 1] - canal_px_[n];
      const double length = glm::length(along);
      if (length > kShortest_px || !std::isfinite(length))
        wall.push_back(zoom * canal_px_[n] + side * wall_px * glm::dvec2(-along.y, along.x) / length);
    }
    drawing.path(wall, 1.5, kCanal);
  }
  if (bur_P_mm)
    if (const auto at = view_.positionOf(*bur_P_mm)) {
      drawing.circle(zoom * at->px, 6.0, 2.0, kBur);
      drawing.cross(zoom * at->px, 10.0, 1.0, kBur);
    }

  // An end in the other half of the jaw has no letter.
  if (view_.columns_P_mm.front().x < 0.0) filmLabel(drawing, "R", {10.0, 0.5 * size.y}, Align::left);
  if (view_.columns_P_mm.back().x > 0.0) filmLabel(drawing, "L", {size.x - 10.0, 0.5 * size.y}, Align::right);
  filmLabel(drawing, "panoramic view, as scanned", {10.0, 14.0}, Align::left);
  filmScale(drawing, size, zoom / view_.pixel_mm, "10 mm");
  return drawing.picture();
}

}  // namespace app

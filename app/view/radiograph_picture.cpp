#include "app/view/radiograph_picture.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "app/report/drawing.h"
#include "app/view/film_marks.h"

namespace app {
namespace {

constexpr double kFilmZoom = 2.0;
/// Of a film's blackening by what bone lets through: a molar in its jaw spans the greys.
constexpr double kContrast_per_mm = 0.075;

std::string tubeText(double shift_deg) {
  if (shift_deg == 0.0) return "tube straight";
  return fmt::format("tube {:g}° to {}", std::abs(shift_deg), shift_deg > 0.0 ? "mesial" : "distal");
}

}  // namespace

render::Image radiographPicture(const assets::PeriapicalView& view, std::span<const float> bone_mm, int fdi,
                                double shift_deg) {
  render::Image film{view.size_px.x, view.size_px.y, {}};
  film.rgba.reserve(4 * bone_mm.size());
  for (const float mm : bone_mm) {
    const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - std::exp(-kContrast_per_mm * mm))));
    film.rgba.insert(film.rgba.end(), {grey, grey, grey, 255});
  }
  const glm::dvec2 size = kFilmZoom * glm::dvec2(view.size_px);
  const Drawing drawing(glm::ivec2(size), 1.0);
  drawing.image(film, {0.0, 0.0}, size);

  filmLabel(drawing, fmt::format("{} · {}", fdi, tubeText(shift_deg)), {10.0, 14.0}, Align::left);
  const bool right = view.mesial_is_right;
  filmLabel(drawing, "mesial", {right ? size.x - 10.0 : 10.0, 0.5 * size.y}, right ? Align::right : Align::left);
  filmScale(drawing, size, kFilmZoom / view.pixel_mm, "10 mm on the film");
  return drawing.picture();
}

}  // namespace app

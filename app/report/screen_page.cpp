#include "app/report/screen_page.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>

namespace app {
namespace {

glm::dvec2 deviceOf(cairo_t* pen, glm::dvec2 p) {
  cairo_user_to_device(pen, &p.x, &p.y);
  return p;
}

}  // namespace

std::uint8_t encoded(double light) {
  const double s = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(s, 0.0, 1.0)));
}

Ink greyOfLight(double share) {
  const double s = encoded(share) / 255.0;
  return {s, s, s};
}

ScreenPage::ScreenPage(const calibration::Rig& rig, glm::ivec2 px) : Drawing(px, 1.0) {
  always_bold_ = true;
  const render::EyeView view = render::eyeView(rig, render::Eye::cyclopean);
  const glm::dvec3 across = view.right_edge_W.xyz, up = view.up_edge_W.xyz, corner = view.lower_left_W.mm;
  middle_W_ = corner + 0.5 * across + 0.5 * up;
  const glm::dvec3 side_a = glm::normalize(across), side_b = glm::normalize(up);
  towards_W_ = glm::normalize(glm::cross(side_a, side_b));
  if (glm::dot(towards_W_, rig.cyclopeanEye().mm - middle_W_) < 0.0) towards_W_ = -towards_W_;

  // The viewer's right: the direction of a panel side that agrees best with the line between the eyes.
  const glm::dvec3 eyes = rig.right_eye.mm - rig.left_eye.mm;
  const bool upright = std::abs(glm::dot(side_a, eyes)) >= std::abs(glm::dot(side_b, eyes));
  const glm::dvec3 along = upright ? side_a : side_b;
  right_W_ = glm::dot(along, eyes) < 0.0 ? -along : along;
  down_W_ = glm::cross(right_W_, towards_W_);
  size_mm_ = {glm::length(upright ? across : up), glm::length(upright ? up : across)};

  // From the page to pixels, rows from the top: affine for every mounting.
  const auto pixel_of = [&](const glm::dvec2& page) {
    const glm::dvec3 p = middle_W_ + page.x * right_W_ + page.y * down_W_ - corner;
    return glm::dvec2(glm::dot(p, across) / glm::dot(across, across) * px.x,
                      (1.0 - glm::dot(p, up) / glm::dot(up, up)) * px.y);
  };
  const glm::dvec2 origin = pixel_of({0.0, 0.0}), x = pixel_of({1.0, 0.0}) - origin, y = pixel_of({0.0, 1.0}) - origin;
  cairo_matrix_t to_pixels;
  cairo_matrix_init(&to_pixels, x.x, x.y, y.x, y.y, origin.x, origin.y);
  cairo_set_matrix(pen(), &to_pixels);
}

double ScreenPage::pixel_mm() const {
  double x = 1.0, y = 0.0;
  cairo_user_to_device_distance(pen(), &x, &y);
  return 1.0 / std::hypot(x, y);
}

glm::dvec2 ScreenPage::seenAt(const calibration::Rig& rig, render::Eye eye, const glm::dvec2& place_mm,
                              double before_mm) const {
  return seenAt(rig, eye, {placeOf(place_mm).mm + before_mm * towards_W_});
}

calibration::Point<calibration::World> ScreenPage::placeOf(const glm::dvec2& place_mm) const {
  return {middle_W_ + place_mm.x * right_W_ + place_mm.y * down_W_};
}

glm::dvec2 ScreenPage::seenAt(const calibration::Rig& rig, render::Eye eye,
                              const calibration::Point<calibration::World>& p_W) const {
  const glm::dvec3 eye_W = eye == render::Eye::left    ? rig.left_eye.mm
                           : eye == render::Eye::right ? rig.right_eye.mm
                                                       : rig.cyclopeanEye().mm;
  const double before_mm = glm::dot(p_W.mm - middle_W_, towards_W_);
  const double eye_before = glm::dot(eye_W - middle_W_, towards_W_);
  const glm::dvec3 on_screen = eye_W + (p_W.mm - eye_W) * (eye_before / (eye_before - before_mm)) - middle_W_;
  return {glm::dot(on_screen, right_W_), glm::dot(on_screen, down_W_)};
}

void ScreenPage::copy(const ScreenPage& other) const {
  cairo_save(pen());
  cairo_identity_matrix(pen());
  cairo_set_source_surface(pen(), cairo_get_target(other.pen()), 0.0, 0.0);
  cairo_paint(pen());
  cairo_restore(pen());
}

void ScreenPage::pixelBox(const glm::dvec2& corner, const glm::dvec2& size, const Ink& ink) const {
  const glm::dvec2 a = glm::round(deviceOf(pen(), corner)), b = glm::round(deviceOf(pen(), corner + size));
  const glm::dvec2 low = glm::min(a, b), extent = glm::max(glm::max(a, b) - low, 1.0);
  cairo_save(pen());
  cairo_identity_matrix(pen());
  box(low, extent, ink);
  cairo_restore(pen());
}

void ScreenPage::frame(double width_mm, const Ink& ink) const {
  outline(-0.5 * size_mm_ + 0.5 * width_mm, size_mm_ - width_mm, width_mm, ink);
}

void ScreenPage::label(const std::string& words, const glm::dvec2& centre, double height_mm, const Ink& ink) const {
  const glm::dvec2 size{textWidth(words, height_mm) + 0.5 * height_mm, 1.5 * height_mm};
  box(centre - 0.5 * size, size, {0.0, 0.0, 0.0});
  text(words, centre, height_mm, ink);
}

}  // namespace app

#include "app/report/screen_page.h"

#include <pango/pangocairo.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "calibration/geometry/units.h"

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

Ink ofLight(double share) {
  const double s = encoded(share) / 255.0;
  return {s, s, s};
}

struct ScreenPage::Sheet {
  Sheet(glm::ivec2 px)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, px.x, px.y)), pen(cairo_create(surface)) {}
  ~Sheet() {
    cairo_destroy(pen);
    cairo_surface_destroy(surface);
  }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  void choose(const Ink& ink) const { cairo_set_source_rgb(pen, ink.red, ink.green, ink.blue); }

  void trace(const std::vector<glm::dvec2>& points) const {
    cairo_new_path(pen);
    for (const glm::dvec2& p : points) cairo_line_to(pen, p.x, p.y);
  }

  cairo_surface_t* surface;
  cairo_t* pen;
};

ScreenPage::ScreenPage(const calibration::Rig& rig, glm::ivec2 px) : sheet_(std::make_unique<Sheet>(px)) {
  const render::EyeView view = render::eyeView(rig, render::Eye::cyclopean);
  const glm::dvec3 across = view.right_edge_W.xyz, up = view.up_edge_W.xyz, corner = view.lower_left_W.mm;
  middle_W_ = corner + 0.5 * across + 0.5 * up;
  const glm::dvec3 side_a = glm::normalize(across), side_b = glm::normalize(up);
  towards_W_ = glm::normalize(glm::cross(side_a, side_b));
  if (glm::dot(towards_W_, rig.cyclopeanEye().mm - middle_W_) < 0.0) towards_W_ = -towards_W_;

  // The person's right is that side of the panel, or its opposite, which goes best with the line between the eyes.
  const glm::dvec3 eyes = rig.right_eye.mm - rig.left_eye.mm;
  const bool upright = std::abs(glm::dot(side_a, eyes)) >= std::abs(glm::dot(side_b, eyes));
  const glm::dvec3 along = upright ? side_a : side_b;
  right_W_ = glm::dot(along, eyes) < 0.0 ? -along : along;
  down_W_ = glm::cross(right_W_, towards_W_);
  size_mm_ = {glm::length(upright ? across : up), glm::length(upright ? up : across)};

  // From the page to pixels, rows from the top: affine, whatever hangs how.
  const auto pixel_of = [&](const glm::dvec2& page) {
    const glm::dvec3 p = middle_W_ + page.x * right_W_ + page.y * down_W_ - corner;
    return glm::dvec2(glm::dot(p, across) / glm::dot(across, across) * px.x,
                      (1.0 - glm::dot(p, up) / glm::dot(up, up)) * px.y);
  };
  const glm::dvec2 origin = pixel_of({0.0, 0.0}), x = pixel_of({1.0, 0.0}) - origin, y = pixel_of({0.0, 1.0}) - origin;
  cairo_matrix_t to_pixels;
  cairo_matrix_init(&to_pixels, x.x, x.y, y.x, y.y, origin.x, origin.y);
  cairo_set_matrix(sheet_->pen, &to_pixels);
}

ScreenPage::~ScreenPage() = default;

double ScreenPage::pixel_mm() const {
  double x = 1.0, y = 0.0;
  cairo_user_to_device_distance(sheet_->pen, &x, &y);
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
  cairo_surface_flush(other.sheet_->surface);
  cairo_surface_flush(sheet_->surface);
  const int stride = cairo_image_surface_get_stride(sheet_->surface);
  const int h = cairo_image_surface_get_height(sheet_->surface);
  assert(stride == cairo_image_surface_get_stride(other.sheet_->surface));
  assert(h == cairo_image_surface_get_height(other.sheet_->surface));
  std::copy_n(cairo_image_surface_get_data(other.sheet_->surface),
              static_cast<std::size_t>(stride) * static_cast<std::size_t>(h),
              cairo_image_surface_get_data(sheet_->surface));
  cairo_surface_mark_dirty(sheet_->surface);
}

void ScreenPage::fill(const Ink& ink) const {
  sheet_->choose(ink);
  cairo_paint(sheet_->pen);
}

void ScreenPage::box(const glm::dvec2& corner, const glm::dvec2& size, const Ink& ink) const {
  sheet_->choose(ink);
  cairo_rectangle(sheet_->pen, corner.x, corner.y, size.x, size.y);
  cairo_fill(sheet_->pen);
}

void ScreenPage::pixelBox(const glm::dvec2& corner, const glm::dvec2& size, const Ink& ink) const {
  const glm::dvec2 a = glm::round(deviceOf(sheet_->pen, corner)), b = glm::round(deviceOf(sheet_->pen, corner + size));
  const glm::dvec2 low = glm::min(a, b), extent = glm::max(glm::max(a, b) - low, 1.0);
  sheet_->choose(ink);
  cairo_save(sheet_->pen);
  cairo_identity_matrix(sheet_->pen);
  cairo_rectangle(sheet_->pen, low.x, low.y, extent.x, extent.y);
  cairo_fill(sheet_->pen);
  cairo_restore(sheet_->pen);
}

void ScreenPage::frame(double width_mm, const Ink& ink) const {
  const glm::dvec2 half = 0.5 * size_mm_ - 0.5 * width_mm;
  line({-half.x, -half.y}, {half.x, -half.y}, width_mm, ink);
  line({half.x, -half.y}, {half.x, half.y}, width_mm, ink);
  line({half.x, half.y}, {-half.x, half.y}, width_mm, ink);
  line({-half.x, half.y}, {-half.x, -half.y}, width_mm, ink);
}

void ScreenPage::line(const glm::dvec2& from, const glm::dvec2& to, double width_mm, const Ink& ink) const {
  sheet_->choose(ink);
  cairo_set_line_cap(sheet_->pen, CAIRO_LINE_CAP_SQUARE);
  cairo_set_line_width(sheet_->pen, width_mm);
  cairo_move_to(sheet_->pen, from.x, from.y);
  cairo_line_to(sheet_->pen, to.x, to.y);
  cairo_stroke(sheet_->pen);
}

void ScreenPage::circle(const glm::dvec2& centre, double radius_mm, double width_mm, const Ink& ink) const {
  sheet_->choose(ink);
  cairo_set_line_width(sheet_->pen, width_mm);
  cairo_new_path(sheet_->pen);
  cairo_arc(sheet_->pen, centre.x, centre.y, radius_mm, 0.0, 2.0 * calibration::kPi);
  cairo_close_path(sheet_->pen);
  cairo_stroke(sheet_->pen);
}

void ScreenPage::path(const std::vector<glm::dvec2>& points, double width_mm, const Ink& ink, bool closed) const {
  if (points.empty()) return;
  sheet_->choose(ink);
  cairo_set_line_cap(sheet_->pen, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(sheet_->pen, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_width(sheet_->pen, width_mm);
  sheet_->trace(points);
  if (closed) cairo_close_path(sheet_->pen);
  cairo_stroke(sheet_->pen);
}

void ScreenPage::polygon(const std::vector<glm::dvec2>& corners, const Ink& ink) const {
  if (corners.empty()) return;
  sheet_->choose(ink);
  sheet_->trace(corners);
  cairo_fill(sheet_->pen);
}

void ScreenPage::disc(const glm::dvec2& centre, double radius_mm, const Ink& ink) const {
  sheet_->choose(ink);
  cairo_new_path(sheet_->pen);
  cairo_arc(sheet_->pen, centre.x, centre.y, radius_mm, 0.0, 2.0 * calibration::kPi);
  cairo_fill(sheet_->pen);
}

void ScreenPage::arc(const glm::dvec2& centre, double radius_mm, double share, double width_mm, const Ink& ink) const {
  const double begins = -0.5 * calibration::kPi;
  sheet_->choose(ink);
  cairo_set_line_cap(sheet_->pen, CAIRO_LINE_CAP_BUTT);
  cairo_set_line_width(sheet_->pen, width_mm);
  cairo_new_path(sheet_->pen);
  cairo_arc(sheet_->pen, centre.x, centre.y, radius_mm, begins,
            begins + 2.0 * calibration::kPi * std::clamp(share, 0.0, 1.0));
  cairo_stroke(sheet_->pen);
}

namespace {

/// Letters are laid out in units so small that no rounding shows, whatever shape the page's pixels have.
constexpr double kUnitsPerMm = 64.0;

/// A line of words; its box in `size`, mm.
PangoLayout* layoutOf(const std::string& words, double height_mm, glm::dvec2& size) {
  PangoContext* context = pango_font_map_create_context(pango_cairo_font_map_get_default());
  pango_context_set_round_glyph_positions(context, FALSE);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  pango_cairo_context_set_font_options(context, options);
  cairo_font_options_destroy(options);
  PangoLayout* layout = pango_layout_new(context);
  g_object_unref(context);
  PangoFontDescription* font = pango_font_description_from_string("DejaVu Sans Bold");
  // Letters' lines are 1.17 times the size of the font.
  pango_font_description_set_absolute_size(font, height_mm / 1.17 * kUnitsPerMm * PANGO_SCALE);
  pango_layout_set_font_description(layout, font);
  pango_font_description_free(font);
  pango_layout_set_text(layout, words.c_str(), -1);
  int w = 0, h = 0;
  pango_layout_get_size(layout, &w, &h);
  size = glm::dvec2(w, h) / (PANGO_SCALE * kUnitsPerMm);
  return layout;
}

/// Its top left there; the layout is used up.
void fillLayout(cairo_t* pen, PangoLayout* layout, const glm::dvec2& corner) {
  cairo_save(pen);
  cairo_translate(pen, corner.x, corner.y);
  cairo_scale(pen, 1.0 / kUnitsPerMm, 1.0 / kUnitsPerMm);
  cairo_move_to(pen, 0.0, 0.0);
  pango_cairo_layout_path(pen, layout);
  cairo_fill(pen);
  cairo_restore(pen);
  g_object_unref(layout);
}

}  // namespace

void ScreenPage::text(const std::string& words, const glm::dvec2& centre, double height_mm, const Ink& ink) const {
  glm::dvec2 size{0.0};
  PangoLayout* layout = layoutOf(words, height_mm, size);
  sheet_->choose(ink);
  fillLayout(sheet_->pen, layout, centre - 0.5 * size);
}

double ScreenPage::textWidth_mm(const std::string& words, double height_mm) const {
  glm::dvec2 size{0.0};
  g_object_unref(layoutOf(words, height_mm, size));
  return size.x;
}

namespace {

PangoLayout* paragraphOf(const std::string& words, double width_mm, double height_mm, double& high_mm) {
  glm::dvec2 size{0.0};
  PangoLayout* layout = layoutOf(words, height_mm, size);
  pango_layout_set_width(layout, static_cast<int>(width_mm * kUnitsPerMm * PANGO_SCALE));
  pango_layout_set_wrap(layout, PANGO_WRAP_WORD_CHAR);
  int w = 0, h = 0;
  pango_layout_get_size(layout, &w, &h);
  high_mm = h / (PANGO_SCALE * kUnitsPerMm);
  return layout;
}

}  // namespace

double ScreenPage::paragraphHeight_mm(const std::string& words, double width_mm, double height_mm) const {
  double high_mm = 0.0;
  g_object_unref(paragraphOf(words, width_mm, height_mm, high_mm));
  return high_mm;
}

double ScreenPage::paragraph(const std::string& words, const glm::dvec2& top, double width_mm, double height_mm,
                             const Ink& ink, Align align) const {
  double high_mm = 0.0;
  PangoLayout* layout = paragraphOf(words, width_mm, height_mm, high_mm);
  pango_layout_set_alignment(layout, align == Align::left    ? PANGO_ALIGN_LEFT
                                     : align == Align::right ? PANGO_ALIGN_RIGHT
                                                             : PANGO_ALIGN_CENTER);
  const double left = align == Align::left ? top.x : align == Align::right ? top.x - width_mm : top.x - 0.5 * width_mm;
  sheet_->choose(ink);
  fillLayout(sheet_->pen, layout, {left, top.y});
  return high_mm;
}

void ScreenPage::label(const std::string& words, const glm::dvec2& centre, double height_mm, const Ink& ink) const {
  glm::dvec2 size{0.0};
  g_object_unref(layoutOf(words, height_mm, size));
  size += 0.5 * height_mm;
  box(centre - 0.5 * size, size, {0.0, 0.0, 0.0});
  text(words, centre, height_mm, ink);
}

render::Picture ScreenPage::picture() const {
  cairo_surface_flush(sheet_->surface);
  const int w = cairo_image_surface_get_width(sheet_->surface), h = cairo_image_surface_get_height(sheet_->surface);
  const int row_bytes = cairo_image_surface_get_stride(sheet_->surface);
  const unsigned char* const rows = cairo_image_surface_get_data(sheet_->surface);
  render::Picture picture{w, h, {}};
  picture.rgba.resize(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  std::uint8_t* to = picture.rgba.data();
  for (int y = 0; y < h; ++y) {
    // Native-endian 0x00RRGGBB.
    const void* const row = rows + y * row_bytes;
    const auto* pixel = static_cast<const std::uint32_t*>(row);
    for (int x = 0; x < w; ++x, ++pixel, to += 4) {
      to[0] = static_cast<std::uint8_t>(*pixel >> 16);
      to[1] = static_cast<std::uint8_t>(*pixel >> 8);
      to[2] = static_cast<std::uint8_t>(*pixel);
      to[3] = 255;
    }
  }
  return picture;
}

}  // namespace app

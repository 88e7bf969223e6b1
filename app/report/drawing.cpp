#include "app/report/drawing.h"

#include <cairo-svg.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include "app/report/markup.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

/// Layout resolution, fine enough that rounding is invisible for every unit and pixel shape.
constexpr double kStepsPerUnit = 64.0 * PANGO_SCALE, kLineOfFont = 1.17;

struct Unref {
  void operator()(void* object) const { g_object_unref(object); }
};
using Layout = std::unique_ptr<PangoLayout, Unref>;

cairo_t* penOn(cairo_surface_t* surface) {
  cairo_t* const pen = cairo_create(surface);
  cairo_surface_destroy(surface);
  return pen;
}

cairo_status_t append(void* text, const unsigned char* data, unsigned int count) {
  static_cast<std::string*>(text)->append(data, data + count);
  return CAIRO_STATUS_SUCCESS;
}

void choose(cairo_t* pen, const Ink& ink) { cairo_set_source_rgba(pen, ink.red, ink.green, ink.blue, ink.opacity); }

void trace(cairo_t* pen, const std::vector<glm::dvec2>& points) {
  cairo_new_path(pen);
  for (const glm::dvec2& p : points) {
    if (std::isfinite(p.x) && std::isfinite(p.y))
      cairo_line_to(pen, p.x, p.y);
    else
      cairo_new_sub_path(pen);
  }
}

/// Strokes the current path.
void stroke(cairo_t* pen, double width, const Ink& ink, const Dashes& dashes = {}) {
  choose(pen, ink);
  cairo_set_line_width(pen, width);
  cairo_set_dash(pen, dashes.data(), static_cast<int>(dashes.size()), 0.0);
  cairo_stroke(pen);
}

Layout layoutOf(const std::string& words, double height, bool bold, double width = 0.0) {
  const std::unique_ptr<PangoContext, Unref> context(pango_font_map_create_context(pango_cairo_font_map_get_default()));
  pango_context_set_round_glyph_positions(context.get(), FALSE);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  pango_cairo_context_set_font_options(context.get(), options);
  cairo_font_options_destroy(options);
  Layout layout(pango_layout_new(context.get()));
  PangoFontDescription* font = pango_font_description_from_string(bold ? "DejaVu Sans Bold" : "DejaVu Sans");
  pango_font_description_set_absolute_size(font, height / kLineOfFont * kStepsPerUnit);
  pango_layout_set_font_description(layout.get(), font);
  pango_font_description_free(font);
  pango_layout_set_text(layout.get(), words.c_str(), -1);
  if (width > 0.0) pango_layout_set_width(layout.get(), static_cast<int>(width * kStepsPerUnit));
  pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
  return layout;
}

glm::dvec2 sizeOf(const Layout& layout) {
  int w = 0, h = 0;
  pango_layout_get_size(layout.get(), &w, &h);
  return glm::dvec2(w, h) / kStepsPerUnit;
}

constexpr std::array kAnchors = {"start", "middle", "end"};
/// Share of the width of a text left of its anchor.
double shareLeft(Align align) { return align == Align::left ? 0.0 : align == Align::right ? 1.0 : 0.5; }

std::string colourOf(const Ink& ink) {
  const auto byte = [](double part) { return static_cast<int>(std::lround(255.0 * part)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(ink.red), byte(ink.green), byte(ink.blue));
}

}  // namespace

Drawing::Drawing(glm::dvec2 size)
    : size_(size), pen_(penOn(cairo_svg_surface_create_for_stream(append, &svg_, size.x, size.y)), cairo_destroy) {}

Drawing::Drawing(glm::ivec2 px, double px_per_unit, Ground ground)
    : size_(glm::dvec2(px) / px_per_unit),
      pen_(penOn(cairo_image_surface_create(ground == Ground::clear ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24, px.x,
                                            px.y)),
           cairo_destroy) {
  cairo_scale(pen(), px_per_unit, px_per_unit);
}

void Drawing::fill(const Ink& ink) const {
  choose(pen(), ink);
  cairo_paint(pen());
}

void Drawing::box(const glm::dvec2& corner, const glm::dvec2& size, const Ink& ink) const {
  choose(pen(), ink);
  cairo_rectangle(pen(), corner.x, corner.y, size.x, size.y);
  cairo_fill(pen());
}

void Drawing::outline(const glm::dvec2& corner, const glm::dvec2& size, double width, const Ink& ink,
                      const Dashes& dashes) const {
  cairo_set_line_join(pen(), CAIRO_LINE_JOIN_MITER);
  cairo_set_line_cap(pen(), CAIRO_LINE_CAP_BUTT);
  cairo_rectangle(pen(), corner.x, corner.y, size.x, size.y);
  stroke(pen(), width, ink, dashes);
}

void Drawing::line(const glm::dvec2& from, const glm::dvec2& to, double width, const Ink& ink,
                   const Dashes& dashes) const {
  cairo_set_line_cap(pen(), dashes.empty() ? CAIRO_LINE_CAP_SQUARE : CAIRO_LINE_CAP_BUTT);
  trace(pen(), {from, to});
  stroke(pen(), width, ink, dashes);
}

void Drawing::path(const std::vector<glm::dvec2>& points, double width, const Ink& ink, bool closed,
                   const Dashes& dashes) const {
  if (points.empty()) return;
  cairo_set_line_cap(pen(), dashes.empty() ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
  cairo_set_line_join(pen(), CAIRO_LINE_JOIN_ROUND);
  trace(pen(), points);
  if (closed) cairo_close_path(pen());
  stroke(pen(), width, ink, dashes);
}

void Drawing::polygon(const std::vector<glm::dvec2>& corners, const Ink& ink) const {
  choose(pen(), ink);
  trace(pen(), corners);
  cairo_fill(pen());
}

void Drawing::circle(const glm::dvec2& centre, double radius, double width, const Ink& ink) const {
  cairo_new_path(pen());
  cairo_arc(pen(), centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_close_path(pen());
  stroke(pen(), width, ink);
}

void Drawing::disc(const glm::dvec2& centre, double radius, const Ink& ink) const {
  choose(pen(), ink);
  cairo_new_path(pen());
  cairo_arc(pen(), centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(pen());
}

void Drawing::arc(const glm::dvec2& centre, double radius, double share, double width, const Ink& ink) const {
  const double begins = -0.5 * std::numbers::pi;
  cairo_set_line_cap(pen(), CAIRO_LINE_CAP_BUTT);
  cairo_new_path(pen());
  cairo_arc(pen(), centre.x, centre.y, radius, begins, begins + 2.0 * std::numbers::pi * std::clamp(share, 0.0, 1.0));
  stroke(pen(), width, ink);
}

void Drawing::cross(const glm::dvec2& centre, double half, double width, const Ink& ink) const {
  line(centre - half, centre + half, width, ink);
  line(centre + glm::dvec2(-half, half), centre + glm::dvec2(half, -half), width, ink);
}

void Drawing::arrow(const glm::dvec2& from, const glm::dvec2& to, double width, const Ink& ink) const {
  const double length = glm::distance(from, to), head = 4.0 + width;
  if (length < head) return line(from, to, width, ink);
  const glm::dvec2 along = (to - from) / length, across(-along.y, along.x);
  line(from, to - 0.7 * head * along, width, ink);
  polygon({to, to - head * along + 0.45 * head * across, to - head * along - 0.45 * head * across}, ink);
}

void Drawing::inside(const glm::dvec2& corner, const glm::dvec2& size, const std::function<void()>& draw) const {
  cairo_save(pen());
  cairo_rectangle(pen(), corner.x, corner.y, size.x, size.y);
  cairo_clip(pen());
  draw();
  cairo_restore(pen());
}

void Drawing::image(const render::Image& picture, const glm::dvec2& corner, const glm::dvec2& size) const {
  std::vector<std::uint32_t> pixels(picture.rgba.size() / 4);
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    const std::uint8_t* const p = &picture.rgba[4 * n];
    pixels[n] = std::uint32_t{p[0]} << 16 | std::uint32_t{p[1]} << 8 | p[2];
  }
  void* const data = pixels.data();
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> source(
      cairo_image_surface_create_for_data(static_cast<unsigned char*>(data), CAIRO_FORMAT_RGB24, picture.w, picture.h,
                                          4 * picture.w),
      cairo_surface_destroy);
  if (isSvg()) {
    // Not by Cairo, whose patterns have the same ids in every drawing of a page.
    std::string png;
    cairo_surface_write_to_png_stream(source.get(), append, &png);
    const std::unique_ptr<char, decltype(&g_free)> text(
        g_base64_encode(reinterpret_cast<const unsigned char*>(png.data()), png.size()), g_free);
    images_ += fmt::format(
        "<image x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" preserveAspectRatio=\"none\" "
        "href=\"data:image/png;base64,{}\"/>\n",
        corner.x, corner.y, size.x, size.y, text.get());
    return;
  }
  cairo_save(pen());
  cairo_translate(pen(), corner.x, corner.y);
  cairo_scale(pen(), size.x / picture.w, size.y / picture.h);
  cairo_set_source_surface(pen(), source.get(), 0.0, 0.0);
  cairo_pattern_set_extend(cairo_get_source(pen()), CAIRO_EXTEND_PAD);
  cairo_rectangle(pen(), 0.0, 0.0, picture.w, picture.h);
  cairo_fill(pen());
  cairo_restore(pen());
}

void Drawing::layer(const Drawing& other, const glm::dvec2& corner) const {
  cairo_set_source_surface(pen(), cairo_get_target(other.pen()), corner.x, corner.y);
  cairo_paint(pen());
}

double Drawing::textWidth(const std::string& words, double height, bool bold) const {
  return sizeOf(layoutOf(words, height, bold || always_bold_)).x;
}

void Drawing::text(const std::string& words, const glm::dvec2& at, double height, const Ink& ink, Align align,
                   bool bold) const {
  const Layout layout = layoutOf(words, height, bold || always_bold_);
  const glm::dvec2 size = sizeOf(layout);
  show(layout.get(), at - size * glm::dvec2(shareLeft(align), 0.5), align, ink);
}

double Drawing::paragraphHeight(const std::string& words, double width, double height) const {
  return sizeOf(layoutOf(words, height, always_bold_, width)).y;
}

double Drawing::paragraph(const std::string& words, const glm::dvec2& top, double width, double height, const Ink& ink,
                          Align align) const {
  const Layout layout = layoutOf(words, height, always_bold_, width);
  pango_layout_set_alignment(layout.get(), align == Align::left    ? PANGO_ALIGN_LEFT
                                           : align == Align::right ? PANGO_ALIGN_RIGHT
                                                                   : PANGO_ALIGN_CENTER);
  show(layout.get(), top - glm::dvec2(shareLeft(align) * width, 0.0), align, ink);
  return sizeOf(layout).y;
}

/// SVG: one <text> per line; pixels: filled outlines.
void Drawing::show(PangoLayout* layout, const glm::dvec2& corner, Align align, const Ink& ink) const {
  if (!isSvg()) {
    choose(pen(), ink);
    cairo_save(pen());
    cairo_translate(pen(), corner.x, corner.y);
    cairo_scale(pen(), PANGO_SCALE / kStepsPerUnit, PANGO_SCALE / kStepsPerUnit);
    cairo_move_to(pen(), 0.0, 0.0);
    pango_cairo_layout_path(pen(), layout);
    cairo_fill(pen());
    cairo_restore(pen());
    return;
  }
  const PangoFontDescription* const font = pango_layout_get_font_description(layout);
  const bool bold = pango_font_description_get_weight(font) == PANGO_WEIGHT_BOLD;
  const std::unique_ptr<PangoLayoutIter, decltype(&pango_layout_iter_free)> at(pango_layout_get_iter(layout),
                                                                               pango_layout_iter_free);
  do {
    PangoRectangle box;
    pango_layout_iter_get_line_extents(at.get(), nullptr, &box);
    const PangoLayoutLine* const line = pango_layout_iter_get_line_readonly(at.get());
    const std::string words(pango_layout_get_text(layout) + line->start_index, static_cast<std::size_t>(line->length));
    const glm::dvec2 place =
        corner +
        glm::dvec2(box.x + shareLeft(align) * box.width, pango_layout_iter_get_baseline(at.get())) / kStepsPerUnit;
    words_ +=
        fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\"{} fill=\"{}\" text-anchor=\"{}\">", place.x,
                    place.y, pango_font_description_get_size(font) / kStepsPerUnit, bold ? " font-weight=\"bold\"" : "",
                    colourOf(ink), kAnchors[static_cast<std::size_t>(align)]) +
        escaped(words) + "</text>\n";
  } while (pango_layout_iter_next_line(at.get()));
}

void Drawing::hint(const glm::dvec2& corner, const glm::dvec2& size, const std::string& words, const std::string& id) {
  if (!isSvg()) return;
  const std::string place = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
      "fill=\"transparent\"><title>{}</title></rect>",
      corner.x, corner.y, size.x, size.y, escaped(words));
  hints_ += id.empty() ? place + "\n" : "<a href=\"#" + id + "\">" + place + "</a>\n";
}

std::string Drawing::markup(std::string_view description) {
  assert(isSvg());
  cairo_surface_finish(cairo_get_target(pen()));
  // Cairo's <svg> element has no label, and its group an unused id.
  const std::size_t shapes = svg_.find('>', svg_.find("<svg")) + 1;
  std::string drawn = svg_.substr(shapes, svg_.rfind("</svg>") - shapes);
  if (const std::size_t id = drawn.find(" id=\"surface"); id != std::string::npos)
    drawn.erase(id, drawn.find('>', id) - id);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 {:.2f} {:.2f}\" width=\"{:.2f}\" "
             "height=\"{:.2f}\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" aria-label=\"",
             size_.x, size_.y, size_.x, size_.y) +
         escaped(description) + "\">" + images_ + drawn + words_ + hints_ + "</svg>\n";
}

void Drawing::save(calibration::OutputFile& file) const {
  if (cairo_surface_write_to_png(cairo_get_target(pen()), file.temporaryPath().c_str()) != CAIRO_STATUS_SUCCESS)
    throw UsageError("image: it cannot be written, check the folder and the free space");
  file.commit();
}

render::Image Drawing::picture() const {
  cairo_surface_t* const surface = cairo_get_target(pen());
  const glm::ivec2 px(cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface));
  render::Image picture{px.x, px.y, {}};
  picture.rgba.resize(4 * static_cast<std::size_t>(px.x) * static_cast<std::size_t>(px.y));
  copyTo(picture, glm::ivec2(0), px);
  return picture;
}

void Drawing::copyTo(render::Image& picture, glm::ivec2 low, glm::ivec2 end) const {
  cairo_surface_t* const surface = cairo_get_target(pen());
  cairo_surface_flush(surface);
  const bool opaque = cairo_image_surface_get_format(surface) == CAIRO_FORMAT_RGB24;
  const int row_bytes = cairo_image_surface_get_stride(surface);
  const unsigned char* const rows = cairo_image_surface_get_data(surface);
  low = glm::max(low, glm::ivec2(0)), end = glm::min(end, glm::ivec2(picture.w, picture.h));
  for (int y = low.y; y < end.y; ++y) {
    // Native-endian 0xAARRGGBB; the alpha of an opaque surface is undefined.
    const void* const row = rows + y * row_bytes;
    const auto* pixel = static_cast<const std::uint32_t*>(row) + low.x;
    std::uint8_t* to = picture.rgba.data() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.w + low.x);
    for (int x = low.x; x < end.x; ++x, ++pixel, to += 4) {
      to[0] = static_cast<std::uint8_t>(*pixel >> 16);
      to[1] = static_cast<std::uint8_t>(*pixel >> 8);
      to[2] = static_cast<std::uint8_t>(*pixel);
      to[3] = opaque ? 255 : static_cast<std::uint8_t>(*pixel >> 24);
    }
  }
}

bool Drawing::isSvg() const { return cairo_surface_get_type(cairo_get_target(pen())) == CAIRO_SURFACE_TYPE_SVG; }

}  // namespace app

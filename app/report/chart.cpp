#include "app/report/chart.h"

#include <cairo.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "app/report/axis_ticks.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

/// Okabe and Ito 2008, the yellow left out: too pale for a line.
constexpr std::array<glm::dvec3, 7> kColours = {{{0.00, 0.45, 0.70},
                                                 {0.84, 0.37, 0.00},
                                                 {0.00, 0.62, 0.45},
                                                 {0.80, 0.47, 0.65},
                                                 {0.90, 0.62, 0.00},
                                                 {0.34, 0.71, 0.91},
                                                 {0.10, 0.10, 0.10}}};
constexpr glm::dvec3 kInk{0.13}, kFaint{0.88}, kGrey{0.42};
constexpr double kText_px = 28.0, kSmall_px = 24.0, kTitle_px = 36.0;
constexpr double kLine_px = 4.5, kThin_px = 2.0;

enum class Anchor { left, middle, right };

/// A page and a pen.
class Page {
 public:
  explicit Page(glm::ivec2 size_px)
      : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, size_px.x, size_px.y), cairo_surface_destroy),
        pen_(cairo_create(surface_.get()), cairo_destroy) {
    colour(glm::dvec3(1.0));
    cairo_paint(pen());
    cairo_set_line_join(pen(), CAIRO_LINE_JOIN_ROUND);
  }

  cairo_t* pen() const { return pen_.get(); }
  void colour(const glm::dvec3& c) const { cairo_set_source_rgb(pen(), c.x, c.y, c.z); }

  void line(const glm::dvec2& a, const glm::dvec2& b, double width_px) const {
    cairo_set_line_width(pen(), width_px);
    cairo_move_to(pen(), a.x, a.y);
    cairo_line_to(pen(), b.x, b.y);
    cairo_stroke(pen());
  }
  void dashes(bool on) const {
    const std::array<double, 2> pattern{14.0, 9.0};
    cairo_set_dash(pen(), pattern.data(), on ? 2 : 0, 0.0);
  }

  /// Text with its top at `at`, as wide as `width_px` allows (0: one line). Returns its size.
  glm::dvec2 text(const std::string& words, glm::dvec2 at, double size_px, Anchor anchor, bool bold = false,
                  double width_px = 0.0, bool draws = true, bool on_white = false) const {
    const std::unique_ptr<PangoLayout, void (*)(void*)> layout(pango_cairo_create_layout(pen()), g_object_unref);
    const std::unique_ptr<PangoFontDescription, void (*)(PangoFontDescription*)> font(
        pango_font_description_from_string("DejaVu Sans, sans-serif"), pango_font_description_free);
    pango_font_description_set_absolute_size(font.get(), size_px * PANGO_SCALE);
    if (bold) pango_font_description_set_weight(font.get(), PANGO_WEIGHT_BOLD);
    pango_layout_set_font_description(layout.get(), font.get());
    pango_layout_set_text(layout.get(), words.c_str(), -1);
    if (width_px > 0.0) pango_layout_set_width(layout.get(), static_cast<int>(width_px * PANGO_SCALE));
    int width = 0, height = 0;
    pango_layout_get_pixel_size(layout.get(), &width, &height);
    const glm::dvec2 size{width, height};
    if (anchor == Anchor::middle) at.x -= 0.5 * size.x;
    if (anchor == Anchor::right) at.x -= size.x;
    if (draws && on_white) {
      cairo_save(pen());
      cairo_set_source_rgba(pen(), 1.0, 1.0, 1.0, 0.85);
      cairo_rectangle(pen(), at.x - 4.0, at.y, size.x + 8.0, size.y);
      cairo_fill(pen());
      cairo_restore(pen());
    }
    if (draws) {
      cairo_move_to(pen(), at.x, at.y);
      pango_cairo_show_layout(pen(), layout.get());
    }
    return size;
  }
  glm::dvec2 sizeOf(const std::string& words, double size_px, bool bold = false, double width_px = 0.0) const {
    return text(words, {}, size_px, Anchor::left, bold, width_px, false);
  }

  void save(calibration::OutputFile& file) const {
    if (cairo_surface_write_to_png(surface_.get(), file.temporaryPath().c_str()) != CAIRO_STATUS_SUCCESS)
      throw UsageError("picture: it can not be written, check the folder and the free space");
    file.commit();
  }

 private:
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> pen_;
};

struct Box {
  glm::dvec2 low{0.0}, high{0.0};  ///< px, y downwards
};

/// The range that holds every finite point, bar and reference line.
glm::dvec2 rangeOf(const Panel& panel, int axis) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  const auto take = [&](double v) {
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  };
  for (const Curve& curve : panel.curves) {
    for (const glm::dvec2& p : curve.points) take(p[axis]);
    if (axis == 1)
      for (const glm::dvec2& bar : curve.bars) take(bar.x), take(bar.y);
  }
  for (const ReferenceLine& line : panel.lines)
    if (line.across == (axis == 1)) take(line.at);
  if (!(high > low)) low = std::isfinite(low) ? low - 0.5 : 0.0, high = low + 1.0;
  return {low, high};
}

class PanelDrawing {
 public:
  PanelDrawing(const Page& page, const Panel& panel, const Box& outside) : page_(page), panel_(panel) {
    const glm::dvec2 x = panel.x_range.value_or(rangeOf(panel, 0)), y = panel.y_range.value_or(rangeOf(panel, 1));
    x_ = axisTicks(x.x, x.y, 6, !panel.x_range);
    y_ = axisTicks(y.x, y.y, 6, !panel.y_range);
    double widest = 0.0;
    for (const double at : y_.at) widest = std::max(widest, page.sizeOf(y_.text(at), kSmall_px).x);
    plot_.low = outside.low + glm::dvec2(widest + 78.0, panel.title.empty() ? 16.0 : 64.0);
    plot_.high = outside.high - glm::dvec2(24.0, 98.0);
    title_at_ = {plot_.low.x, outside.low.y};
    label_x_ = outside.low.x;
  }

  void draw() const {
    drawGrid();
    drawLines();
    cairo_save(page_.pen());
    cairo_rectangle(page_.pen(), plot_.low.x - 8.0, plot_.low.y - 8.0, plot_.high.x - plot_.low.x + 16.0,
                    plot_.high.y - plot_.low.y + 16.0);
    cairo_clip(page_.pen());
    for (const Curve& curve : panel_.curves) drawCurve(curve);
    cairo_restore(page_.pen());
    drawLineLabels();
  }

 private:
  glm::dvec2 place(const glm::dvec2& p) const {
    const glm::dvec2 share{(p.x - x_.low) / (x_.high - x_.low), (p.y - y_.low) / (y_.high - y_.low)};
    return {std::lerp(plot_.low.x, plot_.high.x, share.x), std::lerp(plot_.high.y, plot_.low.y, share.y)};
  }

  void drawGrid() const {
    for (const double at : y_.at) {
      const double y = place({x_.low, at}).y;
      page_.colour(kFaint);
      page_.line({plot_.low.x, y}, {plot_.high.x, y}, kThin_px);
      page_.colour(kInk);
      page_.text(y_.text(at), {plot_.low.x - 14.0, y - 0.5 * page_.sizeOf("0", kSmall_px).y}, kSmall_px, Anchor::right);
    }
    for (const double at : x_.at) {
      const double x = place({at, y_.low}).x;
      page_.colour(kFaint);
      page_.line({x, plot_.low.y}, {x, plot_.high.y}, kThin_px);
      page_.colour(kInk);
      page_.line({x, plot_.high.y}, {x, plot_.high.y + 10.0}, kThin_px);
      page_.text(x_.text(at), {x, plot_.high.y + 14.0}, kSmall_px, Anchor::middle);
    }
    page_.colour(kInk);
    page_.line({plot_.low.x, plot_.low.y}, {plot_.low.x, plot_.high.y}, kThin_px);
    page_.line({plot_.low.x, plot_.high.y}, {plot_.high.x, plot_.high.y}, kThin_px);
    page_.text(panel_.title, title_at_, kText_px, Anchor::left, true);
    page_.text(panel_.x_label, {0.5 * (plot_.low.x + plot_.high.x), plot_.high.y + 52.0}, kText_px, Anchor::middle);
    cairo_save(page_.pen());
    cairo_translate(page_.pen(), label_x_, 0.5 * (plot_.low.y + plot_.high.y));
    cairo_rotate(page_.pen(), -0.5 * std::numbers::pi);
    page_.text(panel_.y_label, {0.0, 0.0}, kText_px, Anchor::middle);
    cairo_restore(page_.pen());
  }

  void drawLines() const {
    page_.colour(kGrey);
    page_.dashes(true);
    for (const ReferenceLine& line : panel_.lines) {
      const glm::dvec2 at = place(line.across ? glm::dvec2(x_.low, line.at) : glm::dvec2(line.at, y_.low));
      if (line.across)
        page_.line({plot_.low.x, at.y}, {plot_.high.x, at.y}, kThin_px + 1.0);
      else
        page_.line({at.x, plot_.low.y}, {at.x, plot_.high.y}, kThin_px + 1.0);
    }
    page_.dashes(false);
  }

  /// Points of curves under a box: what a label put there would hide.
  int hiddenBy(const Box& box) const {
    int hidden = 0;
    for (const Curve& curve : panel_.curves)
      for (const glm::dvec2& p : curve.points) {
        const glm::dvec2 at = place(p);
        hidden += at.x > box.low.x && at.x < box.high.x && at.y > box.low.y && at.y < box.high.y;
      }
    return hidden;
  }

  /// On white, over the curves, at the line, where it hides the least.
  void drawLineLabels() const {
    page_.colour(kGrey);
    for (const ReferenceLine& line : panel_.lines) {
      const glm::dvec2 at = place(line.across ? glm::dvec2(x_.high, line.at) : glm::dvec2(line.at, y_.high));
      const glm::dvec2 size = page_.sizeOf(line.label, kSmall_px);
      std::vector<glm::dvec2> places;
      if (line.across)
        for (const double y : {at.y - size.y - 3.0, at.y + 3.0})
          for (const double x : {plot_.high.x - 8.0 - size.x, plot_.low.x + 12.0}) places.emplace_back(x, y);
      else
        for (const double x : {at.x + 10.0, at.x - 10.0 - size.x})
          for (const double y : {plot_.low.y + 2.0, plot_.high.y - size.y - 4.0}) places.emplace_back(x, y);
      const glm::dvec2 best =
          *std::min_element(places.begin(), places.end(), [&](const glm::dvec2& a, const glm::dvec2& b) {
            return hiddenBy({a, a + size}) < hiddenBy({b, b + size});
          });
      page_.text(line.label, best, kSmall_px, Anchor::left, false, 0.0, true, true);
    }
  }

  void drawCurve(const Curve& curve) const {
    page_.colour(kColours[static_cast<std::size_t>(curve.colour) % kColours.size()]);
    for (std::size_t i = 0; i < curve.bars.size() && i < curve.points.size(); ++i) {
      const double x = curve.points[i].x;
      page_.line(place({x, curve.bars[i].x}), place({x, curve.bars[i].y}), kThin_px + 1.0);
    }
    if (curve.joined) {
      cairo_set_line_width(page_.pen(), kLine_px);
      page_.dashes(curve.dashed);
      bool begun = false;
      for (const glm::dvec2& p : curve.points) {
        const bool is_place = std::isfinite(p.x) && std::isfinite(p.y);
        const glm::dvec2 at = is_place ? place(p) : glm::dvec2(0.0);
        if (is_place && begun) cairo_line_to(page_.pen(), at.x, at.y);
        if (is_place && !begun) cairo_move_to(page_.pen(), at.x, at.y);
        begun = is_place;
      }
      cairo_stroke(page_.pen());
      page_.dashes(false);
    }
    if (!curve.dotted) return;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const glm::dvec2 at = place(curve.points[i]);
      cairo_arc(page_.pen(), at.x, at.y, 7.0 * (i < curve.sizes.size() ? curve.sizes[i] : 1.0), 0.0,
                2.0 * std::numbers::pi);
      cairo_fill(page_.pen());
    }
  }

  const Page& page_;
  const Panel& panel_;
  AxisTicks x_, y_;
  Box plot_;
  glm::dvec2 title_at_{0.0};
  double label_x_ = 0.0;
};

/// Every label once, in rows, centred. Returns the height; draws from `top_px` when asked.
double legend(const Page& page, const Chart& chart, double top_px, bool draws) {
  std::vector<const Curve*> entries;
  for (const Panel& panel : chart.panels)
    for (const Curve& curve : panel.curves) {
      const bool is_known =
          std::any_of(entries.begin(), entries.end(), [&](const Curve* e) { return e->label == curve.label; });
      if (!curve.label.empty() && !is_known) entries.push_back(&curve);
    }
  constexpr double kSample_px = 64.0, kGap_px = 44.0, kRow_px = 44.0;
  const auto width_of = [&](const Curve* e) { return kSample_px + 14.0 + page.sizeOf(e->label, kSmall_px).x; };
  double y = top_px;
  for (std::size_t first = 0; first < entries.size(); y += kRow_px) {
    // As many as fit into this row.
    double width = width_of(entries[first]);
    std::size_t end = first + 1;
    for (; end < entries.size() && width + kGap_px + width_of(entries[end]) < chart.size_px.x - 120.0; ++end)
      width += kGap_px + width_of(entries[end]);
    double x = 0.5 * (chart.size_px.x - width);
    for (; first < end; ++first) {
      const Curve& curve = *entries[first];
      if (draws) {
        page.colour(kColours[static_cast<std::size_t>(curve.colour) % kColours.size()]);
        page.dashes(curve.dashed);
        if (curve.joined) page.line({x, y + 16.0}, {x + kSample_px, y + 16.0}, kLine_px);
        page.dashes(false);
        if (curve.dotted) {
          cairo_arc(page.pen(), x + 0.5 * kSample_px, y + 16.0, 7.0, 0.0, 2.0 * std::numbers::pi);
          cairo_fill(page.pen());
        }
        page.colour(kInk);
        page.text(curve.label, {x + kSample_px + 14.0, y}, kSmall_px, Anchor::left);
      }
      x += width_of(&curve) + kGap_px;
    }
  }
  return y - top_px;
}

}  // namespace

void drawChart(const Chart& chart, calibration::OutputFile& file) {
  const Page page(chart.size_px);
  const double margin = 36.0, width = chart.size_px.x - 2.0 * margin;
  page.colour(kInk);
  page.text(chart.title, {margin, 28.0}, kTitle_px, Anchor::left, true);
  page.colour(kGrey);
  const double caption = chart.caption.empty() ? 0.0 : page.sizeOf(chart.caption, kSmall_px, false, width).y + 14.0;
  page.text(chart.caption, {margin, 82.0}, kSmall_px, Anchor::left, false, width);

  const double top = 112.0 + caption, bottom = chart.size_px.y - legend(page, chart, 0.0, false) - 26.0;
  const double gap = 30.0, count = static_cast<double>(chart.panels.size());
  const double panel_width = (width - gap * (count - 1.0)) / count;
  for (std::size_t i = 0; i < chart.panels.size(); ++i) {
    const double left = margin + static_cast<double>(i) * (panel_width + gap);
    PanelDrawing(page, chart.panels[i], {{left, top}, {left + panel_width, bottom}}).draw();
  }
  legend(page, chart, bottom + 8.0, true);
  page.save(file);
}

}  // namespace app

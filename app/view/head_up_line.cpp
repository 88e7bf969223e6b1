#include "app/view/head_up_line.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "app/text/clock_text.h"
#include "app/view/tool_ring_panel.h"
#include "render/display/eye_projection.h"
#include "render/frame_renderer.h"

namespace app {
namespace {

constexpr double kTextOfHeight = 0.026, kMinText_px = 11.0;
constexpr double kFewerLines = 1.25;  ///< larger letters where an eye gets half the lines
constexpr double kLowSite = 0.62;     ///< of the height: below, the text goes to the upper edge
constexpr double kPlateOfText = 1.7;  ///< height of the line's plate
constexpr int kForceSteps = 24;
constexpr double kShowGapBelow_mm = 10.0;
constexpr double kBesideBur_mm = 7.0, kBesideSite_mm = 13.0;
constexpr double kRulerWidth = 11.0, kRulerRow = 2.3;  ///< heights of the text
constexpr double kRulerEnd_mm = 4.0;
constexpr std::size_t kRulerRows = 3;
constexpr int kLocatorRows = 7;                            ///< of half a millimetre, then APEX
constexpr double kLocatorRow = 1.15, kLocatorWidth = 6.4;  ///< heights of the text
constexpr double kLocatorTop = 0.28;                       ///< of the screen's height

/// Cells of the line from left to right, and which go first where even small letters do not fit.
enum class Cells { bur, drive, water, force, gap, ruler, time };
struct CellWidth {
  Cells cell;
  double widths;  ///< heights of the text
  int importance;
};
constexpr std::array<CellWidth, 7> kCells = {{{Cells::bur, 13.0, 4},
                                              {Cells::drive, 7.2, 1},
                                              {Cells::water, 6.3, 3},
                                              {Cells::force, 10.5, 5},
                                              {Cells::gap, 6.8, 6},
                                              {Cells::ruler, 7.8, 7},
                                              {Cells::time, 4.4, 2}}};

struct LineShape {
  double text_px = 0.0, width_px = 0.0;
  int least_important = 1;  ///< of the cells shown
};

LineShape lineShape(const HeadUpPlace& place, bool with_ruler) {
  const double wanted = place.magnification * kTextOfHeight * place.screen_px.y;
  const double free_px = 0.97 * (place.screen_px.x - place.reserved_left_px);
  for (LineShape shape;; ++shape.least_important) {
    double widths = 0.0;
    for (const CellWidth& cell : kCells)
      if (cell.importance >= shape.least_important && (with_ruler || cell.cell != Cells::ruler)) widths += cell.widths;
    shape.text_px = std::min(wanted, free_px / widths);
    shape.width_px = widths * shape.text_px;
    if (shape.text_px >= std::min(wanted, kMinText_px) || shape.least_important == static_cast<int>(kCells.size()))
      return shape;
  }
}

// Light on a dark plate: legible on bone, teeth and gingiva; amber and red differ in lightness too.
constexpr Ink kPlate{0.05, 0.06, 0.08, 0.62}, kSheet{0.05, 0.06, 0.08, 0.9}, kWhite{0.96, 0.97, 0.98},
    kDim{0.66, 0.7, 0.75}, kBlueWater{0.55, 0.78, 0.98}, kCalm{0.52, 0.82, 0.6}, kRulerGreen{0.3, 0.95, 0.8},
    kAmberPlate{0.96, 0.7, 0.16, 0.94}, kRedPlate{0.78, 0.1, 0.09, 0.94}, kAmberBar{0.97, 0.72, 0.2},
    kRedBar{0.95, 0.3, 0.25}, kBlack{0.06, 0.05, 0.04}, kTrough{1.0, 1.0, 1.0, 0.2};

/// A plate with cut corners.
void plate(const Drawing& drawing, const glm::dvec2& size, double corner, const Ink& ink) {
  const double radius = std::min(corner, 0.3 * std::min(size.x, size.y));
  const glm::dvec2 inner = size - 2.0 * radius;
  drawing.polygon({{radius, 0.0},
                   {radius + inner.x, 0.0},
                   {size.x, radius},
                   {size.x, size.y - radius},
                   {radius + inner.x, size.y},
                   {radius, size.y},
                   {0.0, size.y - radius},
                   {0.0, radius}},
                  ink);
}

void drop(const Drawing& drawing, const glm::dvec2& centre, double radius, const Ink& ink) {
  std::vector<glm::dvec2> outline{{centre.x, centre.y - 1.9 * radius}};
  for (int n = 0; n <= 16; ++n) {
    const double angle = (-0.15 + 1.3 * n / 16.0) * 3.14159265358979;
    outline.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  drawing.polygon(outline, ink);
}

/// A row of the ruler: name and number over a scale with a mark each millimetre.
void drawClearance(const Drawing& to, const HeadUpClearance& near, double top, double width, double text) {
  const Ink ink = !near.is_confirmed                       ? kDim
                  : near.level == assets::RiskLevel::red   ? kRedBar
                  : near.level == assets::RiskLevel::amber ? kAmberBar
                                                           : kCalm;
  const std::string number = near.mm <= 0.0 ? "touched" : fmt::format("{:.1f} mm", near.mm);
  const std::string name = near.is_confirmed ? near.name : near.name + ", not confirmed";
  const double inset = 0.5 * text, letters = 0.9 * text, middle = top + 0.85 * text;
  const double number_width = to.textWidth(number, letters, true);
  const double room = width - 2.4 * inset - number_width, name_width = to.textWidth(name, letters, true);
  to.text(name, {inset, middle}, letters * std::min(1.0, room / name_width), kWhite, Align::left, true);
  to.text(number, {width - inset, middle}, letters, ink, Align::right, true);
  const glm::dvec2 corner{inset, top + 1.55 * text};
  const double length = width - 2.0 * inset, thick = 0.45 * text;
  to.box(corner, {length, thick}, kTrough);
  to.box(corner, {length * std::clamp(near.mm / kRulerEnd_mm, near.mm <= 0.0 ? 1.0 : 0.02, 1.0), thick}, ink);
  for (int mm = 1; mm < static_cast<int>(kRulerEnd_mm); ++mm)
    to.box({corner.x + length * mm / kRulerEnd_mm - 0.5, corner.y - 0.12 * text}, {1.0, thick + 0.24 * text}, kWhite);
}

/// A column from 3.0 down to 0 and APEX, lit down to what is left.
void drawLocator(const Drawing& to, const HeadUpLocator& shown, const glm::dvec2& size, double text) {
  plate(to, size, 0.5 * text, kPlate);
  const double row = kLocatorRow * text, bar = 2.6 * text, left = 0.5 * text;
  to.text("apex", {0.5 * size.x, 0.75 * text}, 0.9 * text, kDim, Align::centre, true);
  for (int n = 0; n <= kLocatorRows; ++n) {
    const bool is_apex_row = n == kLocatorRows;
    const double at_mm = 0.5 * (kLocatorRows - 1 - n), top = 1.4 * text + row * n;
    const bool is_lit = is_apex_row ? shown.is_apex : shown.is_apex || shown.left_mm <= at_mm + 0.25;
    const Ink ink = is_apex_row || at_mm == 0.0 ? kRedBar : at_mm <= 1.0 ? kCalm : kBlueWater;
    to.box({left, top}, {bar, row - 0.15 * text}, is_lit ? ink : kTrough);
    if (is_apex_row || n % 2 == 0 || at_mm == 0.5)
      to.text(is_apex_row ? "APEX" : fmt::format("{:.1f}", at_mm), {size.x - 0.4 * text, top + 0.5 * row}, 0.8 * text,
              is_lit ? kWhite : kDim, Align::right, true);
  }
  to.text(shown.is_apex ? "APEX" : fmt::format("{:.1f} mm", shown.left_mm), {0.5 * size.x, size.y - 0.9 * text},
          1.1 * text, shown.is_apex ? kRedBar : kWhite, Align::centre, true);
}

std::string gapText(double gap_mm) { return gap_mm <= 0.0 ? "contact" : fmt::format("gap {:.1f} mm", gap_mm); }

/// Beside bur and site, on the side where the shaft is not, if there is room.
void placeRuler(const calibration::Rig& rig, const render::Frame& frame, HeadUpPlace& place) {
  const auto of_tool = [&](double z_mm) {
    return placeOnScreen(rig, frame.X_PT * calibration::Point<calibration::Tool>{{0.0, 0.0, z_mm}});
  };
  constexpr double kWay_mm = 10.0;
  const glm::dvec3 across_P_mm = glm::conjugate(rig.X_WP.rotation) * glm::dvec3(kWay_mm, 0.0, 0.0);
  const glm::dvec2 site = placeOnScreen(rig, frame.site_P), bur = of_tool(0.0), shaft = of_tool(20.0),
                   beside = placeOnScreen(rig, {frame.site_P.mm + across_P_mm});
  const double per_mm = glm::distance(site, beside) / kWay_mm;
  const double text = headUpTextHeight_px(place), width = kRulerWidth * text;
  const double right = std::max(site.x + kBesideSite_mm * per_mm, bur.x + kBesideBur_mm * per_mm),
               left = std::min(site.x - kBesideSite_mm * per_mm, bur.x - kBesideBur_mm * per_mm);
  const double room_right = place.screen_px.x - right - width, room_left = left - width - place.reserved_left_px;
  place.ruler_at_left = room_left > 0.0 && (shaft.x >= bur.x || room_right <= 0.0);
  // In steps of a line of text, so that a resting hand leaves it where it is.
  const double step = std::max(1.0, text);
  const double x = place.ruler_at_left ? left : std::min(right, place.screen_px.x - width);
  // The half of the picture where the line and its warnings are is theirs.
  const double y = std::clamp(bur.y, (place.at_top ? 0.42 : 0.15) * place.screen_px.y,
                              (place.at_top ? 0.85 : 0.58) * place.screen_px.y);
  place.ruler_px = glm::ivec2(step * glm::round(glm::dvec2(x, y) / step));
}

}  // namespace

HeadUpPlace headUpPlace(const calibration::Rig& rig, render::DisplayMode mode, const render::Frame& frame) {
  const render::ScreenOrientation orientation = render::screenOrientation(rig);
  HeadUpPlace place;
  place.screen_px = orientation.viewerSize(rig.screen.px);
  constexpr double kSlicesColumn = render::kSliceHeight + 1.6 * render::kInsetGap;
  if (frame.layers.slices) place.reserved_left_px = static_cast<int>(kSlicesColumn * place.screen_px.y);
  const glm::ivec2 eye_px = render::eyeImageSize(mode, rig.screen.px);
  if (eye_px != rig.screen.px || render::isInterleaved(mode)) place.magnification = kFewerLines;
  place.at_top = placeOnScreen(rig, frame.site_P).y > kLowSite * place.screen_px.y;
  placeRuler(rig, frame, place);
  return place;
}

glm::dvec2 placeOnScreen(const calibration::Rig& rig, const calibration::Point<calibration::Patient>& p_P) {
  const render::EyeView view = render::eyeView(rig, render::Eye::cyclopean);
  const glm::dvec4 clip = view.clip_from_W * glm::dvec4((rig.X_WP * p_P).mm, 1.0);
  const glm::ivec2 at(glm::dvec2(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w) * glm::dvec2(rig.screen.px));
  return render::screenOrientation(rig).seenBox({at, {0, 0}}, rig.screen.px).corner_px;
}

double headUpTextHeight_px(const HeadUpPlace& place) { return lineShape(place, false).text_px; }

std::vector<HeadUpLine::Cell> HeadUpLine::cells(const HeadUpContent& c, const HeadUpPlace& place) const {
  std::vector<Cell> cells;
  const LineShape shape = lineShape(place, !c.ruler.empty());
  const double text = shape.text_px, high = std::round(kPlateOfText * text);
  const double free = place.screen_px.x - place.reserved_left_px;
  const double edge = std::round(0.4 * text);
  double y = place.at_top ? edge : place.screen_px.y - edge - high;
  // The cells of the line touch each other.
  double x = place.reserved_left_px + std::round(0.5 * std::max(0.0, free - shape.width_px));
  const auto in_line = [&](Cells which, const std::string& content, auto draw) {
    const CellWidth& cell = kCells[static_cast<std::size_t>(which)];
    if (cell.importance < shape.least_important) return;
    const double end = x + cell.widths * text;
    const glm::ivec2 corner(std::lround(x), std::lround(y)), size(std::lround(end) - std::lround(x), std::lround(high));
    cells.push_back({content, corner, size, [=](const Drawing& to) {
                       to.box({0.0, 0.0}, size, kPlate);
                       draw(to, glm::dvec2(size));
                     }});
    x = end;
  };
  if (c.line_shown) {
    in_line(Cells::bur, c.bur, [=, bur = c.bur](const Drawing& to, const glm::dvec2& size) {
      // A long name in smaller letters.
      const double letters = text * std::min(1.0, (size.x - 1.2 * text) / to.textWidth(bur, text, true));
      to.text(bur, {0.6 * text, 0.5 * size.y}, letters, kWhite, Align::left, true);
    });
    in_line(Cells::drive, c.drive + (c.turning ? " turning" : ""),
            [=, drive = c.drive, ink = c.turning ? kWhite : kDim](const Drawing& to, const glm::dvec2& size) {
              to.text(drive, 0.5 * size, text, ink, Align::centre, true);
            });
    in_line(Cells::water, c.irrigating ? "water" : "dry",
            [=, on = c.irrigating](const Drawing& to, const glm::dvec2& size) {
              drop(to, {0.7 * text, 0.6 * size.y}, 0.32 * text, on ? kBlueWater : kDim);
              to.text(on ? "water on" : "water off", {1.3 * text, 0.5 * size.y}, text, on ? kBlueWater : kDim,
                      Align::left, true);
            });
    const double of_limit = c.torque_Nmm ? c.torque_share : c.force_share;
    const int steps = static_cast<int>(std::lround(kForceSteps * std::clamp(of_limit, 0.0, 1.0)));
    const double number_width = c.torque_Nmm ? 5.9 : 4.3;
    const std::string newtons =
        c.torque_Nmm ? fmt::format("{:.2f} N m", *c.torque_Nmm / 1000.0) : fmt::format("{:.1f} N", c.force_N);
    in_line(Cells::force, fmt::format("{} {}", steps, newtons), [=](const Drawing& to, const glm::dvec2& size) {
      const double share = static_cast<double>(steps) / kForceSteps, bar = size.x - number_width * text;
      const glm::dvec2 corner{0.5 * text, 0.5 * size.y - 0.3 * text};
      to.box(corner, {bar, 0.6 * text}, kTrough);
      to.box(corner, {share * bar, 0.6 * text}, share < 0.7 ? kCalm : share < 0.97 ? kAmberBar : kRedBar);
      to.text(newtons, {size.x - 0.5 * text, 0.5 * size.y}, text, kWhite, Align::right, true);
    });
    const bool near = c.gap_mm && *c.gap_mm < kShowGapBelow_mm;
    const std::string gap = near ? gapText(*c.gap_mm) : "";
    in_line(Cells::gap, gap, [=](const Drawing& to, const glm::dvec2& size) {
      if (!gap.empty()) to.text(gap, 0.5 * size, text, kWhite, Align::centre, true);
    });
    if (!c.ruler.empty())
      in_line(Cells::ruler, c.ruler, [=, ruler = c.ruler](const Drawing& to, const glm::dvec2& size) {
        to.text(ruler, 0.5 * size, text, kRulerGreen, Align::centre, true);
      });
    const std::string time = clockText(c.time_s);
    in_line(Cells::time, time, [=](const Drawing& to, const glm::dvec2& size) {
      to.text(time, {size.x - 0.6 * text, 0.5 * size.y}, text, kWhite, Align::right, true);
    });
  }

  // Towards the middle: warnings, the task, the socket, what keeps the tooth in, then what was just said.
  const auto stacked = [&](const std::string& words, double height, const Ink& ink, const Ink& ground) {
    if (words.empty()) return;
    const double limit = 0.94 * free;
    Drawing measure(glm::ivec2(1), 1.0);
    const double size = std::min(height, height * limit / (measure.textWidth(words, height, true) + 2.0 * height));
    const glm::dvec2 box{std::ceil(measure.textWidth(words, size, true) + 1.6 * size), std::ceil(1.6 * size)};
    const double step = box.y + std::round(0.25 * text);
    if (!c.line_shown && cells.empty())
      y += place.at_top ? 0.0 : high - box.y;
    else
      y += place.at_top ? (cells.empty() ? 0.0 : static_cast<double>(cells.back().size_px.y) + std::round(0.25 * text))
                        : -step;
    const glm::ivec2 corner(place.reserved_left_px + static_cast<int>(0.5 * (free - box.x)), std::lround(y));
    cells.push_back({words + (ground.red > 0.5 ? " !" : ""), corner, glm::ivec2(box), [=](const Drawing& to) {
                       plate(to, box, 0.5 * size, ground);
                       to.text(words, 0.5 * box, size, ink, Align::centre, true);
                     }});
  };
  for (std::size_t n = 0; n < std::min<std::size_t>(2, c.warnings.size()); ++n)
    stacked(c.warnings[n].words, 1.3 * text, c.warnings[n].danger ? kWhite : kBlack,
            c.warnings[n].danger ? kRedPlate : kAmberPlate);
  stacked(c.task, 1.15 * text, kWhite, kPlate);
  stacked(c.site, text, kWhite, kPlate);
  stacked(c.way, text, kWhite, kPlate);
  stacked(c.said, text, kWhite, kPlate);

  // The ruler beside the site: a scale of 4 mm for each structure, filled as far as there is room. Off the other
  // panels.
  if (!c.clearances.empty()) {
    const std::size_t rows = std::min(kRulerRows, c.clearances.size());
    std::string content = "clearance";
    for (std::size_t n = 0; n < rows; ++n) {
      const HeadUpClearance& near = c.clearances[n];
      content += fmt::format("\n{} {:.1f} {} {}", near.name, near.mm, static_cast<int>(near.level), near.is_confirmed);
    }
    const double row_px = kRulerRow * text;
    const glm::ivec2 size(glm::ceil(glm::dvec2(kRulerWidth * text, row_px * static_cast<double>(rows) + 0.5 * text)));
    glm::ivec2 corner = place.ruler_px - glm::ivec2(place.ruler_at_left ? size.x : 0, size.y / 2);
    for (const Cell& cell : cells) {
      if (cell.corner_px.x >= corner.x + size.x || corner.x >= cell.corner_px.x + cell.size_px.x) continue;
      const int below = cell.corner_px.y + cell.size_px.y, gap = static_cast<int>(0.3 * text);
      corner.y = place.at_top ? std::max(corner.y, below + gap) : std::min(corner.y, cell.corner_px.y - size.y - gap);
    }
    cells.push_back({content, corner, size, [=, near = c.clearances](const Drawing& to) {
                       plate(to, size, 0.5 * text, kPlate);
                       for (std::size_t n = 0; n < rows; ++n)
                         drawClearance(to, near[n], row_px * static_cast<double>(n), size.x, text);
                     }});
  }

  // The locator at the left edge, between the halves where text may lie.
  if (c.locator) {
    const glm::ivec2 size(glm::ceil(glm::dvec2(kLocatorWidth, kLocatorRow * (kLocatorRows + 1) + 3.3) * text));
    const glm::ivec2 corner(place.reserved_left_px + static_cast<int>(edge),
                            static_cast<int>(kLocatorTop * place.screen_px.y));
    cells.push_back({fmt::format("locator {:.1f} {}", c.locator->left_mm, c.locator->is_apex), corner, size,
                     [=, shown = *c.locator](const Drawing& to) { drawLocator(to, shown, size, text); }});
  }

  if (!c.keys.empty()) {
    // Two columns of keys and meanings, all in one size: the largest that fits.
    const std::size_t rows = (c.keys.size() + 1) / 2;
    const double usual = std::min(1.05 * text, 0.9 * place.screen_px.y / (1.75 * (static_cast<double>(rows) + 4.0)));
    const Drawing measure(glm::ivec2(1), 1.0);
    double key_px = 0.0;
    glm::dvec2 meaning_px(0.0);
    for (std::size_t n = 0; n < c.keys.size(); ++n) {
      key_px = std::max(key_px, measure.textWidth(c.keys[n].first, usual, true) + usual);
      double& wide_px = n < rows ? meaning_px.x : meaning_px.y;
      wide_px = std::max(wide_px, measure.textWidth(c.keys[n].second, usual, true));
    }
    const double margin = 1.2 * usual, between = 2.0 * usual;
    const double wide_px = 2.0 * (margin + key_px) + between + meaning_px.x + meaning_px.y;
    const double fits = std::min(1.0, 0.97 * place.screen_px.x / wide_px), letters = fits * usual;
    const double row_px = 1.75 * letters, second_px = fits * (key_px + meaning_px.x + between);
    const glm::dvec2 size = glm::ceil(glm::dvec2(fits * wide_px, row_px * (static_cast<double>(rows) + 3.6)));
    const glm::ivec2 corner(0.5 * (glm::dvec2(place.screen_px) - size));
    std::string content = "keys";
    for (const auto& [key, does] : c.keys) content += "\n" + key + "\t" + does;
    cells.push_back(
        {content, corner, glm::ivec2(size), [=, keys = c.keys](const Drawing& to) {
           plate(to, size, 0.8 * letters, kSheet);
           to.text("Keys and mouse", {fits * margin, 1.3 * row_px}, 1.25 * letters, kWhite, Align::left, true);
           to.text("F1 or Esc closes", {size.x - fits * margin, 1.3 * row_px}, letters, kDim, Align::right, true);
           for (std::size_t n = 0; n < keys.size(); ++n) {
             const double left = fits * margin + (n < rows ? 0.0 : second_px);
             const double middle = (static_cast<double>(n % rows) + 2.8) * row_px;
             to.text(keys[n].first, {left, middle}, letters, kBlueWater, Align::left, true);
             to.text(keys[n].second, {left + fits * key_px, middle}, letters, kWhite, Align::left, true);
           }
         }});
  }
  if (!c.ring.names.empty()) {
    const ToolRingPanel ring = toolRingPanel(c.ring, place, text);
    cells.push_back({ring.content, ring.corner_px, ring.size_px, ring.draw});
  }
  return cells;
}

bool HeadUpLine::update(const HeadUpContent& content, const HeadUpPlace& place) {
  const std::vector<Cell> wanted = cells(content, place);
  bool changed = wanted.size() != drawn_.size();
  drawn_.resize(wanted.size());
  panels_.resize(wanted.size());
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    const Cell& cell = wanted[n];
    const std::string as =
        fmt::format("{},{} {}x{} {}", cell.corner_px.x, cell.corner_px.y, cell.size_px.x, cell.size_px.y, cell.content);
    if (as == drawn_[n]) continue;
    const Drawing drawing(cell.size_px, 1.0, Drawing::Ground::clear);
    cell.draw(drawing);
    panels_[n] = {drawing.picture(), cell.corner_px, ++serial_};
    drawn_[n] = as;
    changed = true;
  }
  return changed;
}

}  // namespace app

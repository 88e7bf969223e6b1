#include "app/check_page/check_page.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "app/report/drawing.h"
#include "app/text/letters.h"

namespace app {
namespace {

constexpr Ink kGround = inkOf(0x0d0f12), kPanel = inkOf(0x16191e), kWords = inkOf(0xe6e8ea), kQuiet = inkOf(0x9aa2ab),
              kDim = inkOf(0x565d66), kChosen = inkOf(0x24506b), kButton = inkOf(0x272c33), kAccent = inkOf(0x57b5e8),
              kWarning = inkOf(0xf0b429), kCanal = inkOf(0xfacd3c), kRim = inkOf(0x0e1012), kClick = inkOf(0xff6ad5);
constexpr std::array<Ink, 3> kLights{kWarning, inkOf(0x35b779), inkOf(0xe0533d)};

constexpr double kPanelWidth_px = 304.0, kBar_px = 30.0, kTitle_px = 34.0, kGap_px = 4.0, kRow_px = 20.0,
                 kText_px = 13.0, kButton_px = 26.0, kToolRow_px = 30.0;
constexpr double kNear_mm = 1.5, kHandle_mm = 3.0;
/// Of tools, then actions.
constexpr double kToolRows = static_cast<double>(kCheckTools.size() / 2 + 3);

struct Box {
  glm::dvec2 corner{0.0}, size{0.0};
  bool holds(const glm::dvec2& p) const {
    return glm::all(glm::greaterThanEqual(p, corner)) && glm::all(glm::lessThan(p, corner + size));
  }
};

Box viewBox(JawView view, glm::ivec2 window_px) {
  const double left = kPanelWidth_px + kGap_px, width = std::max(90.0, window_px.x - left),
               height = std::max(60.0, window_px.y - kTitle_px - kBar_px);
  const double top_height = std::floor(0.54 * height), low_height = height - top_height - kGap_px;
  const double axial = std::floor(0.40 * width), slice = std::floor((width - axial) / 2.0) - kGap_px;
  const double unrolled = std::floor(0.56 * width);
  switch (view) {
    case JawView::axial:
      return {{left, kTitle_px}, {axial, top_height}};
    case JawView::across:
      return {{left + axial + kGap_px, kTitle_px}, {slice, top_height}};
    case JawView::along:
      return {{left + axial + slice + 2.0 * kGap_px, kTitle_px}, {slice, top_height}};
    case JawView::panoramic:
      return {{left, kTitle_px + top_height + kGap_px}, {unrolled, low_height}};
    case JawView::solid:
      return {{left + unrolled + kGap_px, kTitle_px + top_height + kGap_px}, {width - unrolled - kGap_px, low_height}};
  }
  return {};
}

Box toolBox(std::size_t tool, glm::ivec2 window_px) {
  const double width = 0.5 * (kPanelWidth_px - 3.0 * kGap_px);
  const double top = window_px.y - kBar_px - kToolRow_px * kToolRows + kToolRow_px * static_cast<double>(tool / 2);
  return {{kGap_px + static_cast<double>(tool % 2) * (width + kGap_px), top}, {width, kButton_px}};
}

/// Confirm and refuse, undo and redo, save and what is said of the pictures.
Box actionBox(std::size_t action, glm::ivec2 window_px) { return toolBox(kCheckTools.size() + action, window_px); }

Box rowBox(std::size_t shown) {
  return {{kGap_px, kTitle_px + kRow_px * static_cast<double>(shown)}, {kPanelWidth_px - 2.0 * kGap_px, kRow_px}};
}

std::size_t rowsThatFit(glm::ivec2 window_px) {
  return static_cast<std::size_t>(std::max(1.0, (toolBox(0, window_px).corner.y - kTitle_px - kGap_px) / kRow_px));
}

std::size_t firstShown(const CheckMenu& menu, glm::ivec2 window_px) {
  const std::size_t fit = rowsThatFit(window_px), count = menu.rows().size();
  if (count <= fit) return 0;
  return std::min(menu.selected() > fit / 2 ? menu.selected() - fit / 2 : 0, count - fit);
}

std::string fitting(const Drawing& page, std::string words, double width) {
  if (page.textWidth(words, kText_px) <= width) return words;
  while (!words.empty() && page.textWidth(words + "…", kText_px) > width) removeLetter(words);
  return words + "…";
}

/// Legible on bone and on air.
void label(const Drawing& page, const std::string& words, const glm::dvec2& at, Align align = Align::centre) {
  for (const glm::dvec2 offset : {glm::dvec2(-1, 0), glm::dvec2(1, 0), glm::dvec2(0, -1), glm::dvec2(0, 1)})
    page.text(words, at + offset, kText_px, kRim, align, true);
  page.text(words, at, kText_px, kWords, align, true);
}

void button(const Drawing& page, const Box& box, const std::string& words, bool is_chosen, bool is_dim) {
  page.box(box.corner, box.size, is_chosen ? kChosen : kButton);
  page.text(words, box.corner + 0.5 * box.size, kText_px, is_dim ? kDim : kWords);
}

/// At the picture's edges.
void directions(const Drawing& page, const Box& box, const std::array<std::string, 4>& left_right_top_bottom) {
  const glm::dvec2 middle = box.corner + 0.5 * box.size, low = box.corner + 12.0, high = box.corner + box.size - 12.0;
  label(page, left_right_top_bottom[0], {box.corner.x + 8.0, middle.y}, Align::left);
  label(page, left_right_top_bottom[1], {box.corner.x + box.size.x - 8.0, middle.y}, Align::right);
  label(page, left_right_top_bottom[2], {middle.x, low.y});
  label(page, left_right_top_bottom[3], {middle.x, high.y});
}

void scaleBar(const Drawing& page, const Box& box, double pixel_mm) {
  const glm::dvec2 to = box.corner + box.size - 14.0, from = to - glm::dvec2(10.0 / pixel_mm, 0.0);
  page.line(from, to, 4.0, kRim);
  page.line(from, to, 2.0, kWords);
  label(page, "10 mm", {from.x - 6.0, from.y}, Align::right);
}

}  // namespace

glm::ivec2 CheckPage::sizeOf(JawView view, glm::ivec2 window_px) const {
  return glm::max(glm::ivec2(viewBox(view, window_px).size), glm::ivec2(16));
}

glm::dvec2 CheckPage::cornerOf(JawView view, glm::ivec2 window_px) const { return viewBox(view, window_px).corner; }

std::optional<CheckPlace> CheckPage::placeAt(const CheckMenu& menu, const glm::dvec2& at_px,
                                             glm::ivec2 window_px) const {
  for (std::size_t view = 0; view < kJawViews; ++view) {
    const Box box = viewBox(static_cast<JawView>(view), window_px);
    if (box.holds(at_px)) return ViewPlace{static_cast<JawView>(view), at_px - box.corner};
  }
  for (std::size_t tool = 0; tool < kCheckTools.size(); ++tool)
    if (toolBox(tool, window_px).holds(at_px)) return kCheckTools[tool].tool;
  for (std::size_t action = 0; action < kCheckActions.size(); ++action)
    if (actionBox(action, window_px).holds(at_px)) return static_cast<CheckAction>(action);
  const std::size_t first = firstShown(menu, window_px);
  for (std::size_t n = 0; n < rowsThatFit(window_px) && first + n < menu.rows().size(); ++n)
    if (rowBox(n).holds(at_px)) return RowPlace{first + n};
  return std::nullopt;
}

const render::Image& CheckPage::viewPicture(JawView view, const CheckMenu& menu, glm::ivec2 px) {
  Kept& kept = kept_[static_cast<std::size_t>(view)];
  const glm::dvec3 at = view == JawView::panoramic || (view == JawView::solid && look.zoom <= 1.01)
                            ? glm::dvec3(0.0)
                            : menu.cursor_P_mm();
  const bool is_slice = view != JawView::panoramic && view != JawView::solid;
  std::string key = fmt::format("{} {} {} {} {} {} {} {}", is_slice ? slice_version_ : version_, px.x, px.y, at.x, at.y,
                                at.z, range.low_hu, range.high_hu);
  if (view == JawView::solid) key += fmt::format(" {} {} {}", look.turn_rad, look.tilt_rad, look.zoom);
  if (key != kept.key) kept = {key, views_.picture(view, menu.cursor_P_mm(), look, range, px)};
  return kept.image;
}

render::Image CheckPage::picture(const CheckMenu& menu, const std::vector<assets::CanalProposal>& canals,
                                 const std::string& title, const CheckProgress& progress, const CheckHand& hand,
                                 glm::ivec2 window_px) {
  const Drawing page(window_px, 1.0);
  page.fill(kGround);
  const glm::dvec3 cursor_P_mm = menu.cursor_P_mm();

  for (std::size_t n = 0; n < kJawViews; ++n) {
    const auto view = static_cast<JawView>(n);
    const glm::ivec2 px = sizeOf(view, window_px);
    const Box box{viewBox(view, window_px).corner, glm::dvec2(px)};
    page.image(viewPicture(view, menu, px), box.corner, box.size);
    const JawViews::Plane plane = views_.planeOf(view, cursor_P_mm, look, px);
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    // In the picture; not finite where the point is not near the slice.
    const auto placed = [&](const glm::dvec3& p_P_mm) {
      if (view == JawView::panoramic) {
        const auto at = views_.inPanoramic(p_P_mm, px);
        return at ? box.corner + *at : glm::dvec2(kNone);
      }
      const glm::dvec3 at = plane.of(p_P_mm);
      return view == JawView::solid || std::abs(at.z) < kNear_mm ? box.corner + glm::dvec2(at) : glm::dvec2(kNone);
    };
    page.inside(box.corner, box.size, [&] {
      for (const assets::CanalProposal& canal : canals) {
        const auto row = std::ranges::find_if(menu.rows(), [&canal](const CheckRow& one) {
          return one.kind == CheckRow::Kind::canal && one.is_right == canal.is_right;
        });
        const Light light = row != menu.rows().end() ? row->light : Light::open;
        std::vector<glm::dvec2> line;
        for (const glm::dvec3& p : canal.line_P_mm) line.push_back(placed(p));
        page.path(line, 2.0, light == Light::refused ? kLights[2] : kCanal, false,
                  light == Light::confirmed ? Dashes{} : Dashes{6.0, 5.0});
        if (view == JawView::across) {
          // Where it passes through the slice.
          for (std::size_t p = 1; p < canal.line_P_mm.size(); ++p) {
            const glm::dvec3 a = plane.of(canal.line_P_mm[p - 1]), b = plane.of(canal.line_P_mm[p]);
            if (a.z * b.z <= 0.0 && a.z != b.z)
              page.circle(box.corner + glm::dvec2(glm::mix(a, b, a.z / (a.z - b.z))), canal.radius_mm / plane.pixel_mm,
                          1.5, kCanal);
          }
        }
      }
      if (!hand.drawn_P_mm.empty()) {
        std::vector<glm::dvec2> line;
        for (const glm::dvec3& p : hand.drawn_P_mm) line.push_back(placed(p));
        page.path(line, 2.0, kClick);
      }
      for (const std::vector<glm::dvec3>& points : hand.canal_points)
        for (const glm::dvec3& p : points) {
          const bool is_off =
              view != JawView::solid && view != JawView::panoramic && std::abs(plane.of(p).z) > kHandle_mm;
          const glm::dvec2 at = view == JawView::panoramic ? placed(p) : box.corner + glm::dvec2(plane.of(p));
          if (is_off || !std::isfinite(at.x)) continue;
          page.disc(at, 6.0, kRim);
          page.disc(at, 4.5, kClick);
        }
      if (hand.brush && hand.brush->view == view) {
        const glm::dvec2 at = box.corner + hand.brush->at_px;
        page.circle(at, menu.brush().radius_mm / plane.pixel_mm, 3.0, kRim);
        page.circle(at, menu.brush().radius_mm / plane.pixel_mm, 1.5, kClick);
      }
      if (const glm::dvec2 at = placed(cursor_P_mm); std::isfinite(at.x)) {
        page.cross(at, 11.0, 3.0, kRim);
        page.cross(at, 10.0, 1.0, kAccent);
      }
      for (const glm::dvec3& p : menu.pending())
        if (const glm::dvec2 at = placed(p); std::isfinite(at.x)) page.cross(at, 7.0, 2.0, kClick);
    });
    const bool is_right = views_.isRight(cursor_P_mm);
    if (view == JawView::axial) directions(page, box, {"R", "L", "A", "P"});
    if (view == JawView::across) {
      const std::string cheek = "cheek", tongue = "tongue";
      directions(page, box, {is_right ? cheek : tongue, is_right ? tongue : cheek, "H", "F"});
    }
    if (view == JawView::along) directions(page, box, {is_right ? "P" : "A", is_right ? "A" : "P", "H", "F"});
    if (view == JawView::panoramic || view == JawView::solid) {
      const bool from_behind = view == JawView::solid && std::cos(look.turn_rad) < 0.0;
      directions(page, box, {from_behind ? "L" : "R", from_behind ? "R" : "L", "", ""});
    }
    static constexpr std::array<const char*, kJawViews> kNames{"parallel to the bite", "across the arch",
                                                               "along the arch", "panoramic", "teeth and canals"};
    label(page, kNames[n], box.corner + glm::dvec2(8.0, 12.0), Align::left);
    if (view != JawView::panoramic) scaleBar(page, box, plane.pixel_mm);
  }

  page.text(fitting(page, title, kPanelWidth_px + 400.0), {10.0, 17.0}, 15.0, kWords, Align::left, true);
  page.text("a training device, not a clinical one", {window_px.x - 8.0, 17.0}, kText_px, kDim, Align::right);
  const std::size_t first = firstShown(menu, window_px), fit = rowsThatFit(window_px);
  page.box({kGap_px, kTitle_px}, {kPanelWidth_px - 2.0 * kGap_px, kRow_px * static_cast<double>(fit)}, kPanel);
  for (std::size_t n = 0; n < fit && first + n < menu.rows().size(); ++n) {
    const CheckRow& row = menu.rows()[first + n];
    const Box box = rowBox(n);
    if (first + n == menu.selected()) page.box(box.corner, box.size, kChosen);
    const glm::dvec2 middle = box.corner + glm::dvec2(0.0, 0.5 * box.size.y);
    page.disc(middle + glm::dvec2(11.0, 0.0), 5.5, kLights[static_cast<std::size_t>(row.light)]);
    // Not by colour alone.
    static constexpr std::array<const char*, 3> kMarks{"?", "✓", "×"};
    page.text(kMarks[static_cast<std::size_t>(row.light)], middle + glm::dvec2(11.0, 0.0), 10.0, kRim, Align::centre,
              true);
    const double beside = page.textWidth(row.beside, kText_px) + 16.0;
    page.text(fitting(page, row.words, box.size.x - 28.0 - beside), middle + glm::dvec2(24.0, 0.0), kText_px,
              row.is_there ? kWords : kQuiet, Align::left);
    page.text(row.beside, middle + glm::dvec2(box.size.x - 6.0, 0.0), kText_px, kQuiet, Align::right);
  }
  for (std::size_t n = 0; n < kCheckTools.size(); ++n) {
    const CheckToolName& tool = kCheckTools[n];
    button(page, toolBox(n, window_px),
           fmt::format("{}  {}", static_cast<char>(std::toupper(static_cast<unsigned char>(tool.key))), tool.name),
           menu.tool() == tool.tool, !menu.mayEdit() && tool.tool != CheckTool::look);
  }
  for (std::size_t n = 0; n < kCheckActions.size(); ++n) {
    const auto action = static_cast<CheckAction>(n);
    const bool is_dim = (!menu.mayEdit() && action != CheckAction::reviewed) ||
                        (action == CheckAction::undo && menu.edits().done() == 0) ||
                        (action == CheckAction::redo && menu.edits().undone() == 0) ||
                        (action == CheckAction::save && !menu.isChanged());
    button(page, actionBox(n, window_px), kCheckActions[n], action == CheckAction::save && !is_dim, is_dim);
  }
  const glm::dvec2 line{10.0, window_px.y - 0.5 * kBar_px};
  const bool works = !progress.stage.empty();
  const std::string words = menu.asks() || (!menu.message().empty() && menu.isTrouble()) ? menu.message()
                            : works ? fmt::format("{} … {:.0f} s · Esc stops", progress.stage, progress.seconds)
                            : !menu.message().empty() ? menu.message()
                                                      : menu.hint();
  page.text(words, line, 14.0,
            menu.isTrouble() && !menu.message().empty() ? kWarning
            : works                                     ? kAccent
                                                        : kWords,
            Align::left);
  page.text("wheel: through the slices · Enter confirms · Ctrl+Z, Ctrl+Y · Ctrl+S saves · Esc leaves",
            {window_px.x - 8.0, line.y}, 12.0, kDim, Align::right);
  return page.picture();
}

}  // namespace app

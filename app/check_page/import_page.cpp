#include "app/check_page/import_page.h"

#include <algorithm>
#include <cstddef>

#include <fmt/core.h>

#include "app/report/drawing.h"

namespace app {
namespace {

constexpr Ink kGround = inkOf(0x0d0f12), kPanel = inkOf(0x16191e), kWords = inkOf(0xe6e8ea), kQuiet = inkOf(0x9aa2ab),
              kDim = inkOf(0x565d66), kButton = inkOf(0x272c33), kAccent = inkOf(0x57b5e8), kDone = inkOf(0x35b779);

constexpr double kWidth_px = 720.0, kName_px = 170.0, kSeconds_px = 80.0, kMostRow_px = 30.0, kTop_px = 180.0,
                 kBelow_px = 110.0;
// Beside slices.
constexpr double kBeside_px = 440.0, kMargin_px = 28.0;
constexpr int kGap_px = 22, kLeastViews_px = 420;
constexpr glm::dvec2 kCancel_px{150.0, 38.0};

/// Where the stages stand.
struct Column {
  double left = 0.0, width = kWidth_px;
};

bool hasViews(glm::ivec2 window_px) {
  return window_px.x >= static_cast<int>(kBeside_px + 3.0 * kMargin_px) + kLeastViews_px &&
         window_px.y >= kLeastViews_px;
}

Column columnOf(glm::ivec2 window_px, bool has_views) {
  if (has_views) return {kMargin_px, kBeside_px};
  return {std::max(8.0, 0.5 * (window_px.x - kWidth_px)), kWidth_px};
}

glm::dvec2 cancelCorner(glm::ivec2 window_px) {
  const Column column = columnOf(window_px, hasViews(window_px));
  return {column.left + column.width - kCancel_px.x, window_px.y - kBelow_px + 20.0};
}

void copyInto(const render::Image& from, glm::ivec2 corner_px, render::Image& page) {
  for (int y = 0; y < from.h; ++y)
    std::copy_n(from.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(y) * from.w,
                4 * static_cast<std::ptrdiff_t>(from.w),
                page.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(corner_px.y + y) * page.w + corner_px.x));
}

/// Sides of the patient beside the names of the slices.
void drawViewNames(const Drawing& page, const std::array<ImportViewBox, 3>& boxes) {
  constexpr const char* kNames[3][3] = {{"R", "axial", "L"}, {"R", "coronal", "L"}, {"A", "sagittal", "P"}};
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    const glm::dvec2 corner(boxes[n].corner_px), size(boxes[n].size_px);
    page.box(corner, size, kPanel);
    const double middle = corner.y - 0.5 * kGap_px;
    page.text(kNames[n][0], {corner.x + 2.0, middle}, 14.0, kWords, Align::left, true);
    page.text(kNames[n][1], {corner.x + 0.5 * size.x, middle}, 13.0, kQuiet, Align::centre);
    page.text(kNames[n][2], {corner.x + size.x - 2.0, middle}, 14.0, kWords, Align::right, true);
  }
}

void bar(const Drawing& page, const glm::dvec2& corner, const glm::dvec2& size, double share, const Ink& ink) {
  page.box(corner, size, kPanel);
  if (share > 0.0) page.box(corner, {std::max(2.0, share * size.x), size.y}, ink);
}

}  // namespace

bool isCancelAt(const glm::dvec2& at_px, glm::ivec2 window_px) {
  const glm::dvec2 inside = at_px - cancelCorner(window_px);
  return glm::all(glm::greaterThanEqual(inside, glm::dvec2(0.0))) && glm::all(glm::lessThan(inside, kCancel_px));
}

std::array<ImportViewBox, 3> importViewBoxes(glm::ivec2 window_px) {
  std::array<ImportViewBox, 3> boxes{};
  if (!hasViews(window_px)) return boxes;
  const int left = static_cast<int>(kBeside_px + 2.0 * kMargin_px), right = window_px.x - static_cast<int>(kMargin_px);
  const int top = 20 + kGap_px, bottom = window_px.y - 40, width = right - left, half = (width - kGap_px) / 2;
  const int above = (bottom - top - kGap_px) * 11 / 20;
  boxes[0] = {{left, top}, {width, above}};
  const int lower = top + above + kGap_px;
  boxes[1] = {{left, lower}, {half, bottom - lower}};
  boxes[2] = {{right - half, lower}, {half, bottom - lower}};
  return boxes;
}

render::Image importPage(const ImportStages& stages, double at_s, const ImportPageText& text, glm::ivec2 window_px,
                         const std::array<render::Image, 3>* slices) {
  const Drawing page(window_px, 1.0);
  page.fill(kGround);
  const bool has_views = text.may_stop && hasViews(window_px);
  const Column column = columnOf(window_px, has_views);
  const double left = column.left, right = left + column.width;
  page.text(text.title, {left, 56.0}, 26.0, kWords, Align::left, true);
  page.paragraph(text.about, {left, 80.0}, column.width, 14.0, kQuiet, Align::left);
  const double whole = stages.share(at_s);
  bar(page, {left, 124.0}, {column.width - kSeconds_px, 18.0}, whole, kAccent);
  page.text(fmt::format("{:.0f} %", 100.0 * whole), {right, 133.0}, 16.0, kWords, Align::right, true);

  const double count = static_cast<double>(std::max<std::size_t>(1, stages.all().size()));
  const double row_px = std::min(kMostRow_px, (window_px.y - kTop_px - kBelow_px) / count);
  double middle_px = kTop_px;
  for (const ImportStage& stage : stages.all()) {
    const bool runs = stage.state == ImportStage::State::runs, waits = stage.state == ImportStage::State::waits;
    page.text(stage.name, {left, middle_px}, 14.0, runs ? kWords : waits ? kDim : kQuiet, Align::left, runs);
    bar(page, {left + kName_px, middle_px - 4.0}, {column.width - kName_px - kSeconds_px, 8.0},
        stages.shareOf(stage, at_s), runs ? kAccent : kDone);
    if (!waits)
      page.text(fmt::format("{:.1f} s", stages.secondsOf(stage, at_s)), {right, middle_px}, 14.0,
                runs ? kWords : kQuiet, Align::right);
    middle_px += row_px;
  }
  if (text.may_stop) {
    const glm::dvec2 corner = cancelCorner(window_px);
    page.box(corner, kCancel_px, kButton);
    page.text("Cancel", corner + 0.5 * kCancel_px, 15.0, kWords, Align::centre, true);
    page.text("Esc cancels too: nothing is left behind.", {left, corner.y + 0.5 * kCancel_px.y}, 13.0, kQuiet,
              Align::left);
  }
  page.text("a training device, not a clinical one", {window_px.x - 8.0, window_px.y - 15.0}, 13.0, kDim, Align::right);
  if (!has_views) return page.picture();
  const std::array<ImportViewBox, 3> boxes = importViewBoxes(window_px);
  drawViewNames(page, boxes);
  if (slices == nullptr)
    page.text("slices come as soon as the scan is read",
              glm::dvec2(boxes[0].corner_px) + 0.5 * glm::dvec2(boxes[0].size_px), 14.0, kQuiet);
  else
    page.text("the wheel goes through a slice", {boxes[0].corner_px.x, window_px.y - 15.0}, 13.0, kDim, Align::left);
  render::Image picture = page.picture();
  for (std::size_t n = 0; slices != nullptr && n < boxes.size(); ++n)
    if ((*slices)[n].w == boxes[n].size_px.x && (*slices)[n].h == boxes[n].size_px.y)
      copyInto((*slices)[n], boxes[n].corner_px, picture);
  return picture;
}

}  // namespace app

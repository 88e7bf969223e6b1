#include "app/check_page/import_page.h"

#include <algorithm>

#include <fmt/core.h>

#include "app/report/drawing.h"

namespace app {
namespace {

constexpr Ink kGround = inkOf(0x0d0f12), kPanel = inkOf(0x16191e), kWords = inkOf(0xe6e8ea), kQuiet = inkOf(0x9aa2ab),
              kDim = inkOf(0x565d66), kButton = inkOf(0x272c33), kAccent = inkOf(0x57b5e8), kDone = inkOf(0x35b779);

constexpr double kWidth_px = 720.0, kName_px = 170.0, kSeconds_px = 80.0, kMostRow_px = 30.0, kTop_px = 180.0,
                 kBelow_px = 110.0;
constexpr glm::dvec2 kCancel_px{150.0, 38.0};

double leftOf(glm::ivec2 window_px) { return std::max(8.0, 0.5 * (window_px.x - kWidth_px)); }

glm::dvec2 cancelCorner(glm::ivec2 window_px) {
  return {leftOf(window_px) + kWidth_px - kCancel_px.x, window_px.y - kBelow_px + 20.0};
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

render::Image importPage(const ImportStages& stages, double at_s, const ImportPageText& text, glm::ivec2 window_px) {
  const Drawing page(window_px, 1.0);
  page.fill(kGround);
  const double left = leftOf(window_px), right = left + kWidth_px;
  page.text(text.title, {left, 56.0}, 26.0, kWords, Align::left, true);
  page.text(text.about, {left, 92.0}, 14.0, kQuiet, Align::left);
  const double whole = stages.share(at_s);
  bar(page, {left, 124.0}, {kWidth_px - kSeconds_px, 18.0}, whole, kAccent);
  page.text(fmt::format("{:.0f} %", 100.0 * whole), {right, 133.0}, 16.0, kWords, Align::right, true);

  const double count = static_cast<double>(std::max<std::size_t>(1, stages.all().size()));
  const double row_px = std::min(kMostRow_px, (window_px.y - kTop_px - kBelow_px) / count);
  double middle_px = kTop_px;
  for (const ImportStage& stage : stages.all()) {
    const bool runs = stage.state == ImportStage::State::runs, waits = stage.state == ImportStage::State::waits;
    page.text(stage.name, {left, middle_px}, 14.0, runs ? kWords : waits ? kDim : kQuiet, Align::left, runs);
    bar(page, {left + kName_px, middle_px - 4.0}, {kWidth_px - kName_px - kSeconds_px, 8.0},
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
  return page.picture();
}

}  // namespace app

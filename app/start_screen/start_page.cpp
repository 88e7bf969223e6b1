#include "app/start_screen/start_page.h"

#include <algorithm>
#include <array>
#include <string>

#include "app/report/drawing.h"
#include "app/text/letters.h"

namespace app {
namespace {

constexpr Ink kGround = inkOf(0x0d0f12), kPanel = inkOf(0x16191e), kWords = inkOf(0xe6e8ea), kQuiet = inkOf(0x9aa2ab),
              kDim = inkOf(0x565d66), kChosen = inkOf(0x24506b), kChosenElsewhere = inkOf(0x272c33),
              kAccent = inkOf(0x57b5e8), kWarning = inkOf(0xf0b429);

constexpr double kRow = 4.4, kText = 2.5, kTitle = 2.6, kTitleRow = 4.6, kInset = 1.2;

/// Where a list stands, and how many of its choices are shown.
struct ListPlace {
  glm::dvec2 corner;
  double width;
  std::size_t rows;
};
constexpr std::array<ListPlace, kStartLists> kLists{{
    {{5.0, 12.0}, 80.0, 5},
    {{5.0, 39.6}, 54.0, 5},
    {{61.0, 39.6}, 24.0, 5},
    {{91.0, 12.0}, 64.0, 4},
    {{91.0, 35.2}, 64.0, 4},
    {{91.0, 58.4}, 34.0, 5},
    {{127.0, 58.4}, 28.0, 5},
    {{5.0, 67.2}, 80.0, 3},
}};
constexpr glm::dvec2 kButton{127.0, 88.5}, kButtonSize{28.0, 7.0};
constexpr double kAboutTop = 86.6, kAboutWidth = 78.0;

/// The page in a window of that size.
struct Scale {
  double px_per_unit;
  glm::dvec2 corner_px;
};
Scale scaleOf(glm::ivec2 window_px) {
  const glm::dvec2 px = glm::max(window_px, 1);
  const double scale = std::min(px.x / kStartPage.x, px.y / kStartPage.y);
  return {scale, 0.5 * (px - scale * kStartPage)};
}

std::size_t firstShown(const StartList& list, std::size_t rows) {
  if (list.choices.size() <= rows) return 0;
  const std::size_t before = rows / 2;
  return std::min(list.chosen > before ? list.chosen - before : 0, list.choices.size() - rows);
}

/// Shortened at its end where it is too wide.
std::string fitting(const Drawing& page, std::string words, double width) {
  if (page.textWidth(words, kText) <= width) return words;
  while (!words.empty() && page.textWidth(words + "…", kText) > width) removeLetter(words);
  return words + "…";
}

void drawList(const Drawing& page, const StartMenu& menu, std::size_t n) {
  const StartList& list = menu.lists()[n];
  const ListPlace& at = kLists[n];
  const bool focused = menu.focus() == n, overruled = menu.isOverruled(n);
  const std::size_t first = firstShown(list, at.rows), shown = std::min(at.rows, list.choices.size());
  std::string title = list.title;
  if (shown < list.choices.size())
    title += ", " + std::to_string(list.chosen + 1) + " of " + std::to_string(list.choices.size());
  page.text(title, at.corner + glm::dvec2(kInset, 0.5 * kTitleRow), kTitle, focused ? kAccent : kQuiet, Align::left,
            true);
  const glm::dvec2 corner = at.corner + glm::dvec2(0.0, kTitleRow);
  page.box(corner, {at.width, static_cast<double>(at.rows) * kRow}, kPanel);
  for (std::size_t row = 0; row < shown; ++row) {
    const StartChoice& choice = list.choices[first + row];
    const glm::dvec2 left = corner + glm::dvec2(0.0, static_cast<double>(row) * kRow);
    const bool chosen = first + row == list.chosen && !overruled;
    if (chosen) page.box(left, {at.width, kRow}, focused ? kChosen : kChosenElsewhere);
    if (chosen) page.box(left, {0.5, kRow}, kAccent);
    const Ink& ink = overruled || !choice.why_not.empty() ? kDim : chosen ? kWords : kQuiet;
    const double beside = choice.beside.empty() ? 0.0 : page.textWidth(choice.beside, kText) + 2.0;
    const glm::dvec2 middle = left + glm::dvec2(0.0, 0.5 * kRow);
    page.text(fitting(page, choice.words, at.width - 2.0 * kInset - beside), middle + glm::dvec2(kInset, 0.0), kText,
              ink, Align::left);
    page.text(choice.beside, middle + glm::dvec2(at.width - kInset, 0.0), kText, overruled ? kDim : kQuiet,
              Align::right);
  }
  if (focused) page.outline(corner, {at.width, static_cast<double>(at.rows) * kRow}, 0.25, kAccent);
}

}  // namespace

std::vector<StartPlace> startPlaces(const StartMenu& menu) {
  std::vector<StartPlace> places;
  for (std::size_t n = 0; n < menu.lists().size(); ++n) {
    const StartList& list = menu.lists()[n];
    const std::size_t first = firstShown(list, kLists[n].rows);
    for (std::size_t row = 0; row < std::min(kLists[n].rows, list.choices.size()); ++row)
      places.push_back({.list = n,
                        .choice = first + row,
                        .corner = kLists[n].corner + glm::dvec2(0.0, kTitleRow + static_cast<double>(row) * kRow),
                        .size = {kLists[n].width, kRow}});
  }
  places.push_back({.starts = true, .corner = kButton, .size = kButtonSize});
  return places;
}

std::optional<StartPlace> startPlaceAt(const StartMenu& menu, const glm::dvec2& at_px, glm::ivec2 window_px) {
  const Scale scale = scaleOf(window_px);
  const glm::dvec2 at = (at_px - scale.corner_px) / scale.px_per_unit;
  for (const StartPlace& place : startPlaces(menu)) {
    const glm::dvec2 inside = at - place.corner;
    if (glm::all(glm::greaterThanEqual(inside, glm::dvec2(0.0))) && glm::all(glm::lessThan(inside, place.size)))
      return place;
  }
  return {};
}

render::Image startPage(const StartMenu& menu, glm::ivec2 window_px) {
  const Scale scale = scaleOf(window_px);
  const Drawing page(glm::ivec2(glm::round(scale.px_per_unit * kStartPage)), scale.px_per_unit);
  page.fill(kGround);
  page.text("Molar", {5.0 + kInset, 7.5}, 6.0, kWords, Align::left, true);
  page.text("a training device, not a clinical one", {155.0, 8.3}, kText, kDim, Align::right);
  for (std::size_t n = 0; n < menu.lists().size(); ++n) drawList(page, menu, n);
  const bool tells = !menu.message().empty();
  page.paragraph(tells ? menu.message() : menu.lists()[menu.focus()].choice().about, {5.0 + kInset, kAboutTop},
                 kAboutWidth, kText, tells && menu.isTrouble() ? kWarning : kWords, Align::left);
  page.box(kButton, kButtonSize, kAccent);
  page.text(menu.startsCheck() ? "Check" : "Start", kButton + 0.5 * kButtonSize, 3.4, kGround, Align::centre, true);
  page.text("Up, Down or wheel choose · Tab, Left, Right next list · Enter starts · Esc leaves", {5.0 + kInset, 97.0},
            2.1, kDim, Align::left);

  // In the middle of the window.
  const render::Image drawn = page.picture();
  render::Image image{window_px.x, window_px.y, {}};
  const auto byte = [](double share) { return static_cast<std::uint8_t>(255.0 * share + 0.5); };
  for (int p = 0; p < window_px.x * window_px.y; ++p)
    image.rgba.insert(image.rgba.end(), {byte(kGround.red), byte(kGround.green), byte(kGround.blue), 255});
  const glm::ivec2 at{glm::round(scale.corner_px)};
  for (int y = 0; y < std::min(drawn.h, window_px.y - at.y); ++y) {
    const auto count = 4 * static_cast<std::ptrdiff_t>(std::min(drawn.w, window_px.x - at.x));
    std::copy_n(drawn.rgba.begin() + 4 * static_cast<std::ptrdiff_t>(y) * drawn.w, count,
                image.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y + at.y) * window_px.x + at.x));
  }
  return image;
}

}  // namespace app

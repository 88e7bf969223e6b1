#include "app/calibrate/page_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "app/calibrate/page_inks.h"

namespace app {
namespace {

// Measures of a 24-inch screen, 531 x 299 mm, from its middle. A line of 13.5 mm has capitals of 8.4 mm.
constexpr double kHalfWidth = 265.5, kHalfHeight = 149.4, kMargin = 10.0;
constexpr double kLine = 13.5, kLarge = 17.0;
constexpr double kTitleTop = -146.0, kSentenceBottom = -93.0, kMessageTop = -90.0, kFieldTop = -62.0,
                 kFieldBottom = 62.0;
constexpr double kTiltTop = 64.0, kProgressTop = 83.0, kHelpBottom = 146.0, kHelpRow = 17.5, kHelpKey = 112.0;
/// Practice on a desk is read from near: smaller than the rest, below it.
constexpr double kKeysTop = 140.5, kKeysLine = 7.5;

/// A page in the measures of a 24-inch screen; `u` mm of the page per mm there.
struct Sheet {
  const ScreenPage& page;
  double u;

  double left() const { return -0.5 * page.size_mm().x / u + kMargin; }
  double right() const { return -left(); }
  double width() const { return 2.0 * right(); }

  double words(const std::string& text, glm::dvec2 top, double width, double height, const Ink& ink,
               Align align) const {
    return page.paragraph(text, u * top, u * width, u * height, ink, align) / u;
  }
  double height(const std::string& text, double width, double line) const {
    return page.paragraphHeight(text, u * width, u * line) / u;
  }
  /// One line, scaled down to fit.
  void line(const std::string& text, glm::dvec2 top, double width, double height, const Ink& ink, Align align) const {
    const double is = page.textWidth(text, u * height) / u, fits = is > width ? width / is : 1.0;
    words(text, {top.x, top.y + 0.5 * (1.0 - fits) * height}, width + 1.0, fits * height, ink, align);
  }
  /// At most `most` lines, scaled down to fit; `bottom`: of the last line, else `top` of the first.
  void lines(int most, const std::string& text, double top, double height, const Ink& ink,
             std::optional<double> bottom = std::nullopt) const {
    // Lines broken at words are a little short.
    const double is = page.textWidth(text, u * height) / u, room = (most > 1 ? 0.93 : 1.0) * most * width();
    const double fits = is > room ? room / is : 1.0;
    const double count = std::ceil(std::max(is * fits, 1.0) / width());
    words(text, {0.0, bottom ? *bottom - count * fits * height : top}, width(), fits * height, ink, Align::centre);
  }
  void box(glm::dvec2 corner, glm::dvec2 size, const Ink& ink) const { page.box(u * corner, u * size, ink); }
  void path(std::vector<glm::dvec2> points, double width, const Ink& ink, bool closed = false) const {
    for (glm::dvec2& p : points) p *= u;
    page.path(points, u * width, ink, closed);
  }
};

std::string minutes(double seconds) {
  const int whole = static_cast<int>(std::ceil(std::clamp(seconds, 0.0, 5999.0) / 5.0)) * 5;
  return fmt::format("{}:{:02} left", whole / 60, whole % 60);
}

/// "12 of 27 · 1:20 left"
std::string progressText(const WizardView& view) {
  std::string words = view.count;
  if (view.time_left_s) words += (words.empty() ? "" : "   ") + minutes(*view.time_left_s);
  return words;
}

void drawHead(const Sheet& sheet, const WizardView& view) {
  sheet.line(view.title, {sheet.left(), kTitleTop}, 0.58 * sheet.width(), kLine, kQuietInk, Align::left);
  sheet.line(progressText(view), {sheet.right(), kTitleTop}, 0.40 * sheet.width(), kLine, kWordInk, Align::right);
  sheet.lines(2, view.sentence, 0.0, kLarge, kWordInk, kSentenceBottom);
}

void drawMessage(const Sheet& sheet, const ShownMessage& message) {
  if (message.text.empty()) return;
  const bool good = message.tone == Tone::good, rejected = message.tone == Tone::reject;
  const std::string mark = good ? "✓ " : rejected ? "✗ " : "";
  sheet.lines(2, mark + message.text, kMessageTop, kLine, good ? kGoodInk : rejected ? kBadInk : kQuietInk);
}

void drawProgress(const Sheet& sheet, double share) {
  sheet.box({sheet.left(), kProgressTop}, {sheet.width(), 4.0}, kFaintInk);
  sheet.box({sheet.left(), kProgressTop}, {std::clamp(share, 0.0, 1.0) * sheet.width(), 4.0}, kWantedInk);
}

void drawHelp(const Sheet& sheet, const ButtonHelp& help, double bottom) {
  struct Row {
    const char* key;
    const std::string& does;
  };
  const std::array rows{Row{"HOLD STILL", help.hold_still}, Row{"PRESS", help.short_press},
                        Row{"LONG PRESS", help.long_press}};
  double y = bottom;
  for (const Row& row : rows) y -= row.does.empty() ? 0.0 : kHelpRow;
  for (const Row& row : rows) {
    if (row.does.empty()) continue;
    sheet.box({sheet.left(), y + 0.75}, {kHelpKey, kHelpRow - 1.5}, kFaintInk);
    sheet.line(row.key, {sheet.left() + 0.5 * kHelpKey, y + 2.0}, kHelpKey - 6.0, kLine, kWantedInk, Align::centre);
    sheet.line(row.does, {sheet.left() + kHelpKey + 8.0, y + 2.0}, sheet.width() - kHelpKey - 8.0, kLine, kWordInk,
               Align::left);
    y += kHelpRow;
  }
}

/// A letter that differs from its mirror images, 80 mm high.
void drawF(const Sheet& sheet) {
  sheet.box({-22.0, -40.0}, {14.0, 80.0}, kWordInk);
  sheet.box({-22.0, -40.0}, {50.0, 14.0}, kWordInk);
  sheet.box({-22.0, -9.0}, {36.0, 14.0}, kWordInk);
}

/// In true millimetres, to be measured with a ruler.
void drawBar(const ScreenPage& page, double length_mm, bool upright) {
  const double half = 0.5 * length_mm;
  const auto at = [&](double along, double across) {
    return upright ? glm::dvec2(across, along) : glm::dvec2(along, across);
  };
  page.line(at(-half, 0.0), at(half, 0.0), 1.0, kWordInk);
  for (const double end : {-half, half}) page.line(at(end, -15.0), at(end, 15.0), 0.5, kWordInk);
}

void drawFacts(const Sheet& sheet, const std::vector<std::string>& facts, double top, double left, double width) {
  for (const std::string& fact : facts)
    top += sheet.words(fact, {left, top}, width, kLine, kWordInk, Align::left) + 2.5;
}

constexpr double kChoiceEdge = 2.5, kChoiceMark = 16.0, kBetweenChoices = 2.0;

double choiceHeight(const Sheet& sheet, const std::string& choice, double width) {
  return sheet.height(choice, width - kChoiceMark - kChoiceEdge, kLine) + 2.0 * kChoiceEdge;
}

double choicesHeight(const Sheet& sheet, const std::vector<std::string>& choices, double width) {
  double all = 0.0;
  for (const std::string& choice : choices) all += choiceHeight(sheet, choice, width) + kBetweenChoices;
  return all;
}

void drawChoices(const Sheet& sheet, const WizardView& view, double top, double left, double width) {
  for (std::size_t n = 0; n < view.choices.size(); ++n) {
    const bool marked = view.marked == n;
    const double high = choiceHeight(sheet, view.choices[n], width);
    if (marked) {
      sheet.box({left, top}, {width, high}, kWantedInk);
      sheet.line("▶", {left + kChoiceEdge, top + kChoiceEdge}, kChoiceMark, kLine, kGroundInk, Align::left);
    }
    sheet.words(view.choices[n], {left + kChoiceMark, top + kChoiceEdge}, width - kChoiceMark - kChoiceEdge, kLine,
                marked ? kGroundInk : kWordInk, Align::left);
    top += high + kBetweenChoices;
  }
}

/// A ticked disc, a triangle with an exclamation mark, a crossed-out square.
void drawVerdict(const Sheet& sheet, const ShownVerdict& shown, double middle) {
  const glm::dvec2 c{-195.0, middle};
  const auto at = [&](double x, double y) { return c + glm::dvec2(x, y); };
  switch (shown.verdict) {
    case calibration::Verdict::green:
      sheet.page.disc(sheet.u * c, sheet.u * 42.0, kGoodInk);
      sheet.path({at(-20.0, 2.0), at(-5.0, 18.0), at(22.0, -16.0)}, 9.0, kGroundInk);
      break;
    case calibration::Verdict::amber:
      sheet.path({at(0.0, -38.0), at(42.0, 34.0), at(-42.0, 34.0)}, 8.0, kDoubtInk, true);
      sheet.path({at(0.0, -12.0), at(0.0, 10.0)}, 9.0, kDoubtInk);
      sheet.page.disc(sheet.u * at(0.0, 23.0), sheet.u * 5.0, kDoubtInk);
      break;
    case calibration::Verdict::red:
      sheet.box(at(-38.0, -38.0), {76.0, 76.0}, kBadInk);
      sheet.path({at(-20.0, -20.0), at(20.0, 20.0)}, 9.0, kGroundInk);
      sheet.path({at(20.0, -20.0), at(-20.0, 20.0)}, 9.0, kGroundInk);
      break;
  }
  sheet.words(shown.sentence, {-135.0, middle - 28.0}, sheet.right() + 135.0, 20.0, kWordInk, Align::left);
}

void drawNumbers(const Sheet& sheet, const std::vector<ShownValue>& numbers) {
  // Between sentence and help; rows get closer if there are many.
  const double top = -89.0, room = 198.0;
  const double row = std::min(kLine + 3.0, room / static_cast<double>(numbers.size()));
  double y = top;
  for (const ShownValue& number : numbers) {
    const double height = std::min(kLine, row);
    sheet.line(number.what, {sheet.left(), y}, 0.60 * sheet.width(), height, kQuietInk, Align::left);
    sheet.line(number.value, {sheet.right(), y}, 0.38 * sheet.width(), height, kWordInk, Align::right);
    y += row;
  }
}

}  // namespace

void drawText(const ScreenPage& page, const WizardView& view) {
  const Sheet sheet{page, 0.5 * std::min(page.size_mm().x / kHalfWidth, page.size_mm().y / kHalfHeight)};
  page.fill(kGroundInk);
  drawHead(sheet, view);
  drawHelp(sheet, view.button, view.practice_keys.empty() ? kHelpBottom : kKeysTop - 1.0);
  sheet.line(view.practice_keys, {0.0, kKeysTop}, sheet.width(), kKeysLine, kQuietInk, Align::centre);
  if (!view.numbers.empty()) return drawNumbers(sheet, view.numbers);

  drawMessage(sheet, view.message);
  if (view.progress) drawProgress(sheet, *view.progress);
  if (view.tilt) sheet.line(view.tilt->words, {0.0, kTiltTop}, sheet.width(), kLine, kWantedInk, Align::centre);
  if (view.verdict) {
    drawVerdict(sheet, *view.verdict, view.choices.empty() ? 0.0 : -28.0);
    return drawChoices(sheet, view, 18.0, -0.3 * sheet.width(), 0.6 * sheet.width());
  }
  if (view.figure == WizardFigure::letter_f) drawF(sheet);
  if (view.figure == WizardFigure::length_bar) drawBar(page, view.bar_mm, false);
  if (view.figure == WizardFigure::upright_length_bar) drawBar(page, view.bar_mm, true);

  // Facts to the left, choices to the right; a single block is centred.
  const bool is_single = view.figure == WizardFigure::none && view.targets.empty() &&
                         (view.facts.empty() + view.value.empty() + view.choices.empty() == 2);
  const double choices_left = is_single ? -0.3 * sheet.width() : 0.16 * sheet.width();
  const double choices_width = is_single ? -2.0 * choices_left : sheet.right() - choices_left;
  const double facts_left = is_single ? -0.4 * sheet.width() : sheet.left();
  const double facts_right = is_single ? -facts_left : view.figure == WizardFigure::none ? choices_left - 8.0 : -56.0;
  drawFacts(sheet, view.facts, kFieldTop, facts_left, facts_right - facts_left);
  sheet.line(view.value, {0.5 * (facts_left + facts_right), view.facts.empty() ? -21.0 : 20.0},
             facts_right - facts_left, 42.0, kWordInk, Align::centre);
  const double centred = -0.5 * choicesHeight(sheet, view.choices, choices_width);
  drawChoices(sheet, view, view.facts.empty() ? std::max(kFieldTop, centred) : kFieldTop, choices_left, choices_width);
}

std::string textOf(const WizardView& view) {
  std::string all;
  const auto add = [&](const std::string& words) { all += words + '\n'; };
  add(view.title), add(view.sentence), add(progressText(view)), add(view.value);
  for (const std::string& fact : view.facts) add(fact);
  for (const std::string& choice : view.choices) add(choice);
  add(view.marked ? std::to_string(*view.marked) : "-");
  add(view.practice_keys), add(view.button.short_press), add(view.button.long_press), add(view.button.hold_still);
  add(std::to_string(static_cast<int>(view.message.tone)) + view.message.text);
  add(std::to_string(static_cast<int>(view.figure)) + ' ' + std::to_string(view.bar_mm));
  add(view.progress ? std::to_string(*view.progress) : "-");
  add(view.tilt ? view.tilt->words : "-");
  add(view.targets.empty() ? "-" : "targets");
  if (view.verdict) add(std::to_string(static_cast<int>(view.verdict->verdict)) + view.verdict->sentence);
  for (const ShownValue& number : view.numbers) add(number.what + '\t' + number.value);
  return all;
}

}  // namespace app

#include "app/check_page/check_page.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/core.h>

#include "app/text/letters.h"

namespace app {
namespace {

constexpr Ink kGround = inkOf(0x0d0f12), kPanel = inkOf(0x16191e), kQuiet = inkOf(0x9aa2ab), kDim = inkOf(0x565d66),
              kChosen = inkOf(0x24506b), kButton = inkOf(0x272c33), kWarning = inkOf(0xf0b429);
constexpr std::array<Ink, 3> kLights{kWarning, inkOf(0x35b779), page_ink::kRefused};

std::string fitting(const Drawing& page, std::string words, double width) {
  if (page.textWidth(words, kPageText_px) <= width) return words;
  while (!words.empty() && page.textWidth(words + "…", kPageText_px) > width) removeLetter(words);
  return words + "…";
}

void button(const Drawing& page, const PageBox& box, const std::string& words, bool is_chosen, bool is_dim) {
  page.box(box.corner, box.size, is_chosen ? kChosen : kButton);
  page.text(words, box.corner + 0.5 * box.size, kPageText_px, is_dim ? kDim : page_ink::kWords);
}

void drawTitle(const Drawing& page, const std::string& title, glm::ivec2 window_px) {
  page.text(fitting(page, title, kPanelWidth_px + 400.0), {10.0, 17.0}, 15.0, page_ink::kWords, Align::left, true);
  page.text("a training device, not a clinical one", {window_px.x - 8.0, 17.0}, kPageText_px, kDim, Align::right);
}

void drawRow(const Drawing& page, const CheckRow& row, const PageBox& box, bool is_selected) {
  if (is_selected) page.box(box.corner, box.size, kChosen);
  const glm::dvec2 middle = box.corner + glm::dvec2(0.0, 0.5 * box.size.y);
  page.disc(middle + glm::dvec2(11.0, 0.0), 5.5, kLights[static_cast<std::size_t>(row.light)]);
  // Not by colour alone.
  static constexpr std::array<const char*, 3> kMarks{"?", "✓", "×"};
  page.text(kMarks[static_cast<std::size_t>(row.light)], middle + glm::dvec2(11.0, 0.0), 10.0, page_ink::kRim,
            Align::centre, true);
  const double beside = page.textWidth(row.beside, kPageText_px) + 16.0;
  page.text(fitting(page, row.words, box.size.x - 28.0 - beside), middle + glm::dvec2(24.0, 0.0), kPageText_px,
            row.is_there ? page_ink::kWords : kQuiet, Align::left);
  page.text(row.beside, middle + glm::dvec2(box.size.x - 6.0, 0.0), kPageText_px, kQuiet, Align::right);
}

void drawList(const Drawing& page, const CheckMenu& menu, glm::ivec2 window_px) {
  const std::size_t first = firstShownRow(menu, window_px), fit = rowsThatFit(window_px);
  const PageBox row = rowBox(0);
  page.box(row.corner, {row.size.x, kRow_px * static_cast<double>(fit)}, kPanel);
  for (std::size_t n = 0; n < fit && first + n < menu.rows().size(); ++n)
    drawRow(page, menu.rows()[first + n], rowBox(n), first + n == menu.selected());
}

DrawnKey listKey(const CheckMenu& menu) {
  DrawnKey key;
  key.add(menu.selected());
  for (const CheckRow& row : menu.rows()) key.add(row.words).add(row.beside).add(row.light).add(row.is_there);
  return key;
}

bool isDim(const CheckMenu& menu, CheckAction action) {
  return (!menu.mayEdit() && action != CheckAction::reviewed) ||
         (action == CheckAction::undo && menu.edits().done() == 0) ||
         (action == CheckAction::redo && menu.edits().undone() == 0) ||
         (action == CheckAction::save && !menu.isChanged());
}

void drawTools(const Drawing& page, const CheckMenu& menu, glm::ivec2 window_px) {
  for (std::size_t n = 0; n < kCheckTools.size(); ++n) {
    const CheckToolName& tool = kCheckTools[n];
    button(page, toolBox(n, window_px),
           fmt::format("{}  {}", static_cast<char>(std::toupper(static_cast<unsigned char>(tool.key))), tool.name),
           menu.tool() == tool.tool, !menu.mayEdit() && tool.tool != CheckTool::look);
  }
  for (std::size_t n = 0; n < kCheckActions.size(); ++n) {
    const auto action = static_cast<CheckAction>(n);
    const bool is_dim = isDim(menu, action);
    button(page, actionBox(n, window_px), kCheckActions[n], action == CheckAction::save && !is_dim, is_dim);
  }
}

DrawnKey toolsKey(const CheckMenu& menu) {
  DrawnKey key;
  key.add(menu.tool()).add(menu.mayEdit());
  for (std::size_t n = 0; n < kCheckActions.size(); ++n) key.add(isDim(menu, static_cast<CheckAction>(n)));
  return key;
}

struct Line {
  std::string words;
  enum class Tone : std::uint8_t { usual, works, trouble } tone = Tone::usual;
};

Line lineOf(const CheckMenu& menu, const CheckProgress& progress) {
  const bool works = !progress.stage.empty(), has_message = !menu.message().empty();
  Line line;
  line.tone = menu.isTrouble() && has_message ? Line::Tone::trouble : works ? Line::Tone::works : Line::Tone::usual;
  line.words = menu.asks() || (has_message && menu.isTrouble()) ? menu.message()
               : works       ? fmt::format("{} … {:.0f} s{}", progress.stage, progress.seconds,
                                     progress.may_stop ? " · Esc stops" : "")
               : has_message ? menu.message()
                             : menu.hint();
  return line;
}

void drawLine(const Drawing& page, const Line& line, glm::ivec2 window_px) {
  const glm::dvec2 at{10.0, window_px.y - 0.5 * kBar_px};
  static constexpr std::array<Ink, 3> kTones{page_ink::kWords, page_ink::kAccent, kWarning};
  page.text(line.words, at, 14.0, kTones[static_cast<std::size_t>(line.tone)], Align::left);
  page.text("wheel: through the slices · Enter confirms · Ctrl+Z, Ctrl+Y · Ctrl+S saves · Esc leaves",
            {window_px.x - 8.0, at.y}, 12.0, kDim, Align::right);
}

assets::CellBox around(const assets::CellBox& a, const assets::CellBox& b) {
  if (a.isEmpty()) return b;
  return b.isEmpty() ? a : assets::CellBox{glm::min(a.low, b.low), glm::max(a.end, b.end)};
}

}  // namespace

glm::ivec2 CheckPage::sizeOf(JawView view, glm::ivec2 window_px) const {
  return glm::max(glm::ivec2(viewBox(view, window_px).size), glm::ivec2(16));
}

glm::dvec2 CheckPage::cornerOf(JawView view, glm::ivec2 window_px) const { return viewBox(view, window_px).corner; }

std::optional<CheckPlace> CheckPage::placeAt(const CheckMenu& menu, const glm::dvec2& at_px,
                                             glm::ivec2 window_px) const {
  for (std::size_t view = 0; view < kJawViews; ++view) {
    const PageBox box = viewBox(static_cast<JawView>(view), window_px);
    if (box.holds(at_px)) return ViewPlace{static_cast<JawView>(view), at_px - box.corner};
  }
  for (std::size_t tool = 0; tool < kCheckTools.size(); ++tool)
    if (toolBox(tool, window_px).holds(at_px)) return kCheckTools[tool].tool;
  for (std::size_t action = 0; action < kCheckActions.size(); ++action)
    if (actionBox(action, window_px).holds(at_px)) return static_cast<CheckAction>(action);
  const std::size_t first = firstShownRow(menu, window_px);
  for (std::size_t n = 0; n < rowsThatFit(window_px) && first + n < menu.rows().size(); ++n)
    if (rowBox(n).holds(at_px)) return RowPlace{first + n};
  return std::nullopt;
}

void CheckPage::changed(const assets::CellBox& voxels, bool still_drawn) {
  is_still_drawn_ = still_drawn;
  for (KeptView& kept : kept_) kept.changed = around(kept.changed, voxels);
}

bool CheckPage::refresh(JawView view, const CheckMenu& menu, glm::ivec2 px) {
  KeptView& kept = kept_[static_cast<std::size_t>(view)];
  const bool is_slice = view != JawView::panoramic && view != JawView::solid;
  const bool has_cursor = is_slice || (view == JawView::solid && look.zoom > 1.01);
  DrawnKey key;
  key.add(px).add(range).add(has_cursor ? menu.cursor_P_mm() : glm::dvec3(0.0));
  if (view == JawView::solid) key.add(look);
  if (kept.key != key) {
    kept.image = views_.picture(view, menu.cursor_P_mm(), look, range, px);
    kept.key = std::move(key);
    kept.changed = {};
    return true;
  }
  if (kept.changed.isEmpty() || (is_still_drawn_ && !is_slice)) return false;
  return views_.redraw(view, menu.cursor_P_mm(), look, range, std::exchange(kept.changed, {}), kept.image);
}

void CheckPage::drawView(const MarkedView& marked, bool is_new) {
  KeptView& kept = kept_[static_cast<std::size_t>(marked.view)];
  DrawnKey marks = marksKey(marked), words = viewWordsKey(marked);
  if (!is_new && kept.marks == marks && kept.words_of == words) return;
  if (!kept.words || kept.words_of != words) {
    kept.words = std::make_unique<Drawing>(glm::ivec2(marked.box.size), 1.0, Drawing::Ground::clear);
    drawViewWords(*kept.words, marked);
    kept.words_of = std::move(words);
  }
  kept.marks = std::move(marks);
  page_->inside(marked.box.corner, marked.box.size, [&] {
    page_->image(kept.image, marked.box.corner, marked.box.size);
    drawMarks(*page_, marked);
    page_->layer(*kept.words, marked.box.corner);
  });
  show(marked.box);
}

void CheckPage::begin(glm::ivec2 window_px) {
  if (page_ && window_px == window_px_) return;
  window_px_ = window_px;
  page_ = std::make_unique<Drawing>(window_px, 1.0);
  page_->fill(kGround);
  picture_ = page_->picture();
  parts_ = {};
  for (KeptView& kept : kept_) kept.marks.reset();
}

template <class Draw>
void CheckPage::drawPart(PagePart part, DrawnKey key, const Draw& draw) {
  std::optional<DrawnKey>& kept = parts_[static_cast<std::size_t>(part)];
  if (kept == key) return;
  kept = std::move(key);
  const PageBox box = partBox(part, window_px_);
  page_->inside(box.corner, box.size, [&] {
    page_->box(box.corner, box.size, kGround);
    draw(*page_);
  });
  show(box);
}

void CheckPage::show(const PageBox& box) {
  page_->copyTo(picture_, glm::ivec2(glm::floor(box.corner)), glm::ivec2(glm::ceil(box.corner + box.size)));
}

const render::Image& CheckPage::picture(const CheckMenu& menu, const std::vector<assets::CanalProposal>& canals,
                                        const std::string& title, const CheckProgress& progress, const CheckHand& hand,
                                        glm::ivec2 window_px) {
  begin(window_px);
  for (std::size_t n = 0; n < kJawViews; ++n) {
    const auto view = static_cast<JawView>(n);
    const glm::ivec2 px = sizeOf(view, window_px);
    const bool is_new = refresh(view, menu, px);
    const PageBox box{viewBox(view, window_px).corner, glm::dvec2(px)};
    drawView({view, box, views_.planeOf(view, menu.cursor_P_mm(), look, px), views_, menu, canals, hand, look}, is_new);
  }
  drawPart(PagePart::title, DrawnKey().add(title), [&](const Drawing& page) { drawTitle(page, title, window_px); });
  drawPart(PagePart::list, listKey(menu), [&](const Drawing& page) { drawList(page, menu, window_px); });
  drawPart(PagePart::tools, toolsKey(menu), [&](const Drawing& page) { drawTools(page, menu, window_px); });
  const Line line = lineOf(menu, progress);
  drawPart(PagePart::line, DrawnKey().add(line.words).add(line.tone),
           [&](const Drawing& page) { drawLine(page, line, window_px); });
  return picture_;
}

}  // namespace app

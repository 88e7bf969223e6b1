#include "app/check_page/check_menu.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "assets/tooth.h"

namespace app {

double lineLength_mm(const std::vector<glm::dvec3>& line) {
  double length = 0.0;
  for (std::size_t n = 1; n < line.size(); ++n) length += glm::distance(line[n - 1], line[n]);
  return length;
}

std::string paintName(std::uint8_t as) {
  return as == assets::kPaintNothing ? "erase" : as == assets::kPaintBone ? "bone" : fmt::format("tooth {}", as);
}

std::vector<CheckRow> checkRows(const assets::JawSegmentation& jaw, const CheckEdits& edits, int operated_fdi) {
  std::vector<CheckRow> rows;
  const auto add_teeth = [&](bool numbered) {
    for (const assets::FoundTooth& tooth : jaw.teeth) {
      if ((tooth.fdi != 0) != numbered) continue;
      CheckRow row;
      row.fdi = tooth.fdi;
      row.words = numbered ? fmt::format("{} {}", tooth.fdi, assets::toothName(tooth.fdi)) : "a piece without a number";
      row.beside = fmt::format("{:.0f} mm³", tooth.volume_mm3);
      if (tooth.fdi == operated_fdi && numbered) row.words += ", operated";
      if (tooth.told_fdi != 0) row.light = Light::confirmed;
      row.at_P_mm = tooth.centre_P_mm;
      rows.push_back(std::move(row));
    }
  };
  add_teeth(true);
  add_teeth(false);
  for (std::size_t n = 0; n < edits.done(); ++n)
    if (const auto* const click = std::get_if<assets::ToothClick>(&edits.all()[n]);
        click != nullptr && click->edit == assets::ToothEdit::no_tooth) {
      CheckRow row;
      row.words = "no tooth", row.light = Light::refused, row.is_there = false, row.at_P_mm = click->at_P_mm[0];
      rows.push_back(std::move(row));
    }
  for (const bool is_right : {true, false}) {
    const auto found = std::ranges::find(jaw.canals, is_right, &assets::CanalProposal::is_right);
    // Of a scan of one side the other has nothing that could be found.
    const auto has_teeth = [&](bool of_right) {
      return std::ranges::any_of(jaw.teeth, [of_right](const assets::FoundTooth& tooth) {
        return tooth.fdi != 0 && assets::isRight(tooth.fdi) == of_right;
      });
    };
    if (found == jaw.canals.end() && !has_teeth(is_right) && has_teeth(!is_right)) continue;
    CheckRow row;
    row.kind = CheckRow::Kind::canal, row.is_right = is_right;
    row.words = is_right ? "canal on the right" : "canal on the left";
    row.is_there = found != jaw.canals.end();
    if (row.is_there) {
      row.length_mm = lineLength_mm(found->line_P_mm);
      const std::optional<bool> word = edits.wordOn(is_right, row.length_mm);
      if (word.value_or(found->is_confirmed)) row.light = Light::confirmed;
      if (word && !*word) row.light = Light::refused;
      row.beside = fmt::format("{} {:.0f} mm", found->is_confirmed ? "clicked," : "proposed,", row.length_mm);
      row.at_P_mm = found->line_P_mm[found->line_P_mm.size() / 2];
    } else {
      row.beside = "not found", row.light = Light::refused;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

CheckMenu::CheckMenu(CheckEdits edits, bool may_edit, const CheckEdits& saved)
    : edits_(std::move(edits)), may_edit_(may_edit), saved_(saved.inForce()) {}

void CheckMenu::saved() { saved_ = edits_.inForce(); }

bool CheckMenu::add(CheckEdit edit) {
  if (!may_edit_) {
    say("teeth and canal came with this scan: there is nothing of the program's to correct", true);
    return false;
  }
  if (!edits_.add(std::move(edit))) {
    say(fmt::format("{} edits are the most; save, or undo some", CheckEdits::kMost), true);
    return false;
  }
  say("", false);
  return true;
}

void CheckMenu::choose(CheckTool tool) {
  tool_ = tool;
  pending_.clear();
  begins_canal_ = true;
  number_ = 0;
  asks_ = asks_review_ = false;
  // The brush begins with the tooth that is looked at.
  if (tool == CheckTool::brush && selected_ < rows_.size() && rows_[selected_].fdi != 0)
    brush_.as = static_cast<std::uint8_t>(rows_[selected_].fdi);
  say("", false);
}

void CheckMenu::select(std::size_t row) {
  if (row >= rows_.size()) return;
  selected_ = row;
  if (rows_[row].is_there || rows_[row].kind == CheckRow::Kind::tooth) cursor_P_mm_ = rows_[row].at_P_mm;
}

void CheckMenu::selectTooth(int fdi) {
  const auto row = std::ranges::find_if(
      rows_, [fdi](const CheckRow& one) { return one.kind == CheckRow::Kind::tooth && one.fdi == fdi; });
  if (fdi != 0 && row != rows_.end()) selected_ = static_cast<std::size_t>(row - rows_.begin());
}

void CheckMenu::moveSelection(int by) {
  if (rows_.empty()) return;
  const auto count = static_cast<int>(rows_.size());
  select(static_cast<std::size_t>(std::clamp(static_cast<int>(selected_) + by, 0, count - 1)));
}

void CheckMenu::showRows(std::vector<CheckRow> rows) {
  const CheckRow before = selected_ < rows_.size() ? rows_[selected_] : CheckRow{};
  const bool is_first = rows_.empty();
  rows_ = std::move(rows);
  const auto same = std::ranges::find_if(rows_, [&before](const CheckRow& row) {
    return row.kind == before.kind && row.fdi == before.fdi && row.is_right == before.is_right &&
           row.is_there == before.is_there;
  });
  selected_ = same != rows_.end() ? static_cast<std::size_t>(same - rows_.begin()) : 0;
  if (!is_first) return;
  const auto operated =
      std::ranges::find_if(rows_, [](const CheckRow& row) { return row.words.ends_with("operated"); });
  if (operated != rows_.end()) select(static_cast<std::size_t>(operated - rows_.begin()));
}

void CheckMenu::refuseLast(const std::string& why) {
  edits_.drop();
  say(why + "; taken back", true);
}

/// In force and last, or not computed yet: the lights do not show it before.
bool CheckMenu::isSaid(const CheckEdit& edit) const {
  if (edits_.last() != nullptr && *edits_.last() == edit) return true;
  const auto end = edits_.all().begin() + static_cast<std::ptrdiff_t>(edits_.done());
  return is_busy_ && std::find(edits_.all().begin(), end, edit) != end;
}

void CheckMenu::sayOnce(CheckEdit edit) {
  if (isSaid(edit)) return say("it is said already", false);
  add(std::move(edit));
}

void CheckMenu::confirm(const CheckRow& row) {
  if (row.light == Light::confirmed) return say("it is confirmed already", false);
  if (!row.is_there) return say("it is not there: click it, or undo", true);
  if (row.kind == CheckRow::Kind::canal) return sayOnce(CanalWord{row.is_right, true, row.length_mm});
  if (row.fdi == 0) return say("it has no number: choose Number, type it, click the piece", true);
  sayOnce(assets::ToothClick{assets::ToothEdit::number, {row.at_P_mm, {}}, row.fdi});
}

void CheckMenu::refuse(const CheckRow& row) {
  if (!row.is_there || row.light == Light::refused) return say("it is refused already", false);
  if (row.kind == CheckRow::Kind::canal)
    sayOnce(CanalWord{row.is_right, false, row.length_mm});
  else
    sayOnce(assets::ToothClick{assets::ToothEdit::no_tooth, {row.at_P_mm, {}}, 0});
}

CheckMenu::Answer CheckMenu::act(CheckAction action) {
  asks_ = false;
  const bool asked_review = std::exchange(asks_review_, false);
  pending_.clear();
  begins_canal_ = true;
  switch (action) {
    case CheckAction::confirm:
    case CheckAction::refuse:
      if (selected_ < rows_.size())
        action == CheckAction::confirm ? confirm(rows_[selected_]) : refuse(rows_[selected_]);
      return Answer::none;
    case CheckAction::undo:
      say(edits_.undo() ? "" : "nothing to undo", false);
      return Answer::none;
    case CheckAction::redo:
      say(edits_.redo() ? "" : "nothing to redo", false);
      return Answer::none;
    case CheckAction::save:
      if (!may_edit_ || !isChanged()) {
        say("nothing has changed", false);
        return Answer::none;
      }
      if (is_busy_) {
        say("it is still being computed: save when it is shown", true);
        return Answer::none;
      }
      return Answer::save;
    case CheckAction::reviewed:
      if (asked_review) return Answer::reviewed;
      if (may_edit_ && isChanged()) {
        say("save first: pictures count as reviewed until the next change is saved", true);
        return Answer::none;
      }
      asks_review_ = true;
      say("You looked at all pictures of this scan and they name nobody? Press again to say so", true);
      return Answer::none;
  }
  return Answer::none;
}

CheckMenu::Answer CheckMenu::take(const render::KeyPressed& key) {
  if (!key.down) return Answer::none;
  asks_review_ = false;
  if (key.control && key.key == render::keyOf('Z')) return act(key.shift ? CheckAction::redo : CheckAction::undo);
  if (key.control && key.key == render::keyOf('Y')) return act(CheckAction::redo);
  if (key.control && key.key == render::keyOf('S')) return act(CheckAction::save);
  if (key.key == render::Key::up) moveSelection(-1);
  if (key.key == render::Key::down) moveSelection(1);
  if (key.key == render::Key::enter) return act(CheckAction::confirm);
  if (key.key == render::Key::erase) return act(CheckAction::refuse);
  if (key.key == render::Key::backspace) number_ = 0;
  if (key.key != render::Key::escape) return Answer::none;
  if (asks_) return Answer::leave;
  if (!pending_.empty() || tool_ != CheckTool::look) {
    choose(CheckTool::look);
    return Answer::none;
  }
  if (!isChanged()) return Answer::leave;
  asks_ = true;
  say("Not saved: Ctrl+S saves · Esc leaves, the edits are kept for the next time · any other key goes on", true);
  return Answer::none;
}

void CheckMenu::type(char32_t letter) {
  if (letter > 126) return;
  const char small = static_cast<char>(std::tolower(static_cast<int>(letter)));
  asks_ = asks_review_ = false;
  if (tool_ == CheckTool::number && std::isdigit(static_cast<unsigned char>(small)) != 0) {
    number_ = number_ >= 10 ? small - '0' : 10 * number_ + (small - '0');
    return;
  }
  if (tool_ == CheckTool::brush && std::string_view("0123456789[]g").find(small) != std::string_view::npos)
    return setBrush(small);
  for (const CheckToolName& tool : kCheckTools)
    if (tool.key == small) return choose(tool.tool);
  if (letter == U'u') act(CheckAction::undo);
  if (letter == U'U') act(CheckAction::redo);
}

void CheckMenu::setBrush(char letter) {
  static constexpr std::array kRadii_mm{assets::kLeastBrush_mm, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, assets::kMostBrush_mm};
  const auto now = std::ranges::lower_bound(kRadii_mm, brush_.radius_mm);
  if (letter == '[') brush_.radius_mm = now == kRadii_mm.begin() ? *now : *(now - 1);
  if (letter == ']') brush_.radius_mm = now + 1 >= kRadii_mm.end() ? kRadii_mm.back() : *(now + 1);
  if (letter == 'g') brush_.only_like_here = !brush_.only_like_here;
  if (letter == '0') brush_.as = assets::kPaintNothing;
  if (letter == '9') brush_.as = assets::kPaintBone;
  if (letter >= '1' && letter <= '8')
    brush_.as = static_cast<std::uint8_t>((is_cursor_right_ ? 40 : 30) + (letter - '0'));
  say("", false);
}

void CheckMenu::addCanal(CanalClicks canal) {
  if (canal.at_P_mm.size() < assets::kLeastCanalClicks) return say("a canal has at least both of its ends", true);
  if (canal.at_P_mm.size() > assets::kMostCanalClicks)
    return say(fmt::format("a canal has at most {} points", assets::kMostCanalClicks), true);
  pending_.clear();
  begins_canal_ = !add(std::move(canal));
}

void CheckMenu::clickCanal(const glm::dvec3& p_P_mm, bool is_right) {
  const auto* const last = edits_.last() != nullptr ? std::get_if<CanalClicks>(edits_.last()) : nullptr;
  if (!begins_canal_ && last != nullptr) {
    if (last->at_P_mm.size() >= assets::kMostCanalClicks)
      return say(fmt::format("a canal has at most {} points; press C to begin it anew", assets::kMostCanalClicks),
                 true);
    add(CanalClicks{last->is_right, withPoint(last->at_P_mm, p_P_mm)});
    return;
  }
  pending_.push_back(p_P_mm);
  if (pending_.size() < assets::kLeastCanalClicks) return;
  begins_canal_ = !add(CanalClicks{is_right, std::exchange(pending_, {})});
}

void CheckMenu::clickAt(const glm::dvec3& p_P_mm, bool is_right) {
  asks_ = asks_review_ = false;
  cursor_P_mm_ = p_P_mm;
  if (tool_ == CheckTool::look) return say("", false);
  if (tool_ == CheckTool::canal) return clickCanal(p_P_mm, is_right);
  assets::ToothClick click;
  click.at_P_mm[0] = p_P_mm;
  switch (tool_) {
    case CheckTool::third_molar:
      click.edit = assets::ToothEdit::number, click.fdi = is_right ? 48 : 38;
      break;
    case CheckTool::number:
      if (number_ < 31 || number_ > 48 || !assets::isToothNumber(number_))
        return say("type the tooth's number first, 31 to 38 or 41 to 48", true);
      click.edit = assets::ToothEdit::number, click.fdi = std::exchange(number_, 0);
      break;
    case CheckTool::same_tooth:
    case CheckTool::two_teeth:
      pending_.push_back(p_P_mm);
      if (pending_.size() < 2) return say("", false);
      click.edit = tool_ == CheckTool::same_tooth ? assets::ToothEdit::same_tooth : assets::ToothEdit::two_teeth;
      click.at_P_mm = {pending_[0], pending_[1]};
      pending_.clear();
      break;
    case CheckTool::no_tooth:
      click.edit = assets::ToothEdit::no_tooth;
      break;
    case CheckTool::cut:
      pending_.push_back(p_P_mm);
      if (pending_.size() == 3) add(assets::JawCut{pending_[0], pending_[1], pending_[2]}), pending_.clear();
      return;
    default:
      click.edit = assets::ToothEdit::root_tip;
      break;
  }
  add(click);
}

std::string CheckMenu::hint() const {
  const auto tool = std::ranges::find(kCheckTools, tool_, &CheckToolName::tool);
  std::string words = std::string(tool->name) + ": " + tool->about;
  if (tool_ == CheckTool::brush)
    words = fmt::format("Brush: {}, {:g} mm, {} · keys 1 to 8 tooth, 9 bone, 0 erase, [ ] size, G grey",
                        paintName(brush_.as), 2.0 * brush_.radius_mm,
                        brush_.only_like_here ? "only as grey as where it begins" : "whatever is there");
  if (tool_ == CheckTool::number && number_ != 0) words += fmt::format(" · {}", number_);
  if (pending_.size() == 1) words += " · one place clicked, Esc forgets it";
  if (pending_.size() == 2) words += " · both ends clicked, now a place beyond the line";
  return words;
}

}  // namespace app

#include "app/check_page/check_run.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <limits>
#include <string_view>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "app/case/gutter_plan.h"
#include "app/check_page/check_picture.h"
#include "app/options/jaw_clicks_file.h"
#include "assets/import/found_jaw.h"
#include "assets/import/tooth_site.h"
#include "assets/load_error.h"
#include "assets/patient/patient_folder.h"
#include "assets/patient/statement_file.h"
#include "assets/scenery/gingiva_surface.h"
#include "assets/segment/cell_masks.h"
#include "assets/toml_reader.h"
#include "assets/tooth.h"
#include "calibration/output_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostLog_bytes = 1u << 24;
constexpr double kClick_px = 4.0, kTurn_rad_per_px = 0.01, kMostTilt_rad = 1.4, kHuPerPx = 6.0;

bool exists(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

/// What the folder was made with.
CheckEdits savedEdits(const std::string& folder, const assets::Patient& patient, double midline_x_P_mm) {
  CheckEdits edits;
  const std::string path = assets::clicksPath(folder);
  if (exists(path)) edits = CheckEdits(readJawClicks(path), midline_x_P_mm);
  const bool is_right = assets::isRight(patient.operatedTooth());
  const assets::JawClicks clicks = edits.clicks();
  const bool was_clicked = std::ranges::any_of(clicks.canals, [&](const std::vector<glm::dvec3>& canal) {
    return (canal.front().x + canal.back().x < 2.0 * midline_x_P_mm) == is_right;
  });
  if (patient.found && patient.found->canal && !was_clicked && patient.mandibular_canal_P_mm.size() >= 2)
    edits.add(CanalWord{is_right, true, lineLength_mm(patient.mandibular_canal_P_mm)});
  return edits;
}

/// What the jaw is found with; strokes and cuts are painted on it.
assets::JawClicks clicksToFind(const CheckEdits& edits) {
  assets::JawClicks clicks = edits.clicks();
  clicks.voxels.clear();
  return clicks;
}

/// Without which of a file's clicks it is: here it is the one that was made last.
std::string ofTheLastClick(const std::string& refusal) {
  std::string_view words = refusal;
  constexpr std::string_view kClicks = "clicks: ", kTooth = "tooth click ";
  if (words.starts_with(kClicks)) words.remove_prefix(kClicks.size());
  if (const auto end = words.find(": "); words.starts_with(kTooth) && end != std::string_view::npos)
    words.remove_prefix(end + 2);
  return std::string(words);
}

double secondsSince(std::chrono::steady_clock::time_point begun) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

struct Edits {
  CheckEdits now, saved;
};

/// With those of last time, unless they are of another import of this folder.
Edits editsOf(const std::string& folder, const assets::Patient& patient, double midline_x_P_mm) {
  Edits edits;
  if (!patient.found) return edits;
  edits.now = edits.saved = savedEdits(folder, patient, midline_x_P_mm);
  const std::string log = checkLogPath(folder);
  if (!exists(log)) return edits;
  CheckEdits kept = CheckEdits::fromText(assets::readSmallFile(log, kMostLog_bytes), log);
  const bool is_same = kept.clicks() == edits.saved.clicks();
  if (kept.wasSaved() && !is_same) return edits;
  if (kept.wasSaved()) edits.saved = kept;
  edits.now = std::move(kept);
  return edits;
}

/// A canal that was refused leaves no label.
void takeAway(const assets::CanalProposal& canal, const assets::VolumeGrid& grid, std::vector<std::uint8_t>& label) {
  for (const glm::dvec3& p : canal.line_P_mm)
    assets::forCellsNear(grid.indexFromPoint(p), canal.radius_mm + grid.spacing_mm, grid.spacing_mm, grid.size,
                         [&](glm::ivec3 ijk, double) {
                           std::uint8_t& here = label[grid.index(ijk)];
                           if (assets::Tissue{here} == assets::Tissue::mandibular_canal)
                             here = static_cast<std::uint8_t>(assets::Tissue::trabecular);
                         });
}

std::string wordsOnSaved(assets::StatementAfterEdits statement) {
  switch (statement) {
    case assets::StatementAfterEdits::review_lapsed:
      return "saved; its pictures count as not reviewed again: press Pictures reviewed when you have looked";
    case assets::StatementAfterEdits::left_unsigned:
      return "saved; its deidentified.toml was changed by somebody else and is not signed again: import the scan again";
    default:
      return "saved";
  }
}

/// The patient of what is shown.
assets::Patient checkedPatient(assets::Patient patient, assets::JawSegmentation jaw, const CheckEdits& edits) {
  std::erase_if(jaw.canals, [&](assets::CanalProposal& canal) {
    const std::optional<bool> word = edits.wordOn(canal.is_right, lineLength_mm(canal.line_P_mm));
    if (word) canal.is_confirmed = *word;
    if (!word || *word) return false;
    takeAway(canal, patient.ct.grid, jaw.label);
    return true;
  });
  assets::takeFoundJaw(std::move(jaw), patient);
  patient.gingiva = assets::gingivaSurface(patient.ct, planGutter(patient, kUsualBurRadius_mm));
  return patient;
}

}  // namespace

std::string checkLogPath(const std::string& folder) {
  const fs::path path = fs::path(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).string() + ".check.json";
}

CheckRun::CheckRun(std::string folder, ReportLine report)
    : folder_(std::move(folder)),
      report_(std::move(report)),
      patient_(assets::loadPatient(folder_)),
      may_edit_(patient_.found && assets::canHoldJaw(patient_.ct.grid)),
      views_(patient_, whatIn(patient_)),
      menu_([this] {
        Edits edits = editsOf(folder_, patient_, views_.midline_x_P_mm());
        return CheckMenu(std::move(edits.now), may_edit_, edits.saved);
      }()),
      page_(views_),
      painted_(patient_.ct, foundIn(patient_)),
      stroke_(menu_, painted_, views_, page_, patient_.ct),
      canal_(menu_),
      logged_(menu_.edits()),
      was_logged_saved_(!menu_.isChanged()) {
  menu_.moveCursor(patient_.focus_P_mm());
  showFound();
  if (!may_edit_) {
    menu_.say("teeth and canal came with this scan: they can be looked at", false);
    return;
  }
  if (menu_.isChanged()) menu_.say("with the edits of last time, which were not saved", false);
  search_ = std::make_unique<JawSearch>(patient_.ct);
  askIfChanged();
}

CheckRun::~CheckRun() {
  if (saving_.valid()) saving_.wait();
}

void CheckRun::showFound() {
  std::vector<CheckRow> rows = checkRows(found(), menu_.edits(), patient_.site ? patient_.site->fdi : 0);
  for (CheckRow& row : rows)
    if (row.kind == CheckRow::Kind::tooth && row.is_there)
      row.at_P_mm = views_.nearestOf(row.fdi != 0 ? static_cast<std::uint8_t>(row.fdi) : kPieceVoxel, row.at_P_mm);
  // A folder keeps the operated side's canal alone.
  if (may_edit_ && !painted_.isFound())
    for (CheckRow& row : rows)
      if (row.kind == CheckRow::Kind::canal && !row.is_there) row.beside = "is looked for", row.light = Light::open;
  menu_.showRows(std::move(rows));
  is_changed_ = true;
}

void CheckRun::keepLog(bool is_saved) {
  const CheckEdits& edits = menu_.edits();
  if (is_saved == was_logged_saved_ && edits.done() == logged_.done() && edits.all() == logged_.all()) return;
  logged_ = edits, was_logged_saved_ = is_saved;
  try {
    calibration::OutputFile(checkLogPath(folder_), true).commit(edits.text(is_saved));
  } catch (const calibration::CalibrationError& error) {
    if (!is_log_lost_) report_(error.what());
    if (!is_log_lost_) menu_.say("edits cannot be kept beside the patient: save before you leave", true);
    is_log_lost_ = true;
  }
}

void CheckRun::askIfChanged() {
  if (!search_) return;
  keepLog(!menu_.isChanged());
  const assets::JawClicks clicks = clicksToFind(menu_.edits());
  if (clicks != asked_) {
    asked_ = clicks;
    clicks == shown_ ? search_->leaveIt() : search_->ask(clicks);
  }
  paintIfChanged();
  menu_.setBusy(isBusy());
}

void CheckRun::paintIfChanged() {
  if (stroke_.isDrawn()) return;
  assets::CellBox changed = assets::noCells(views_.grid().size);
  const bool could = painted_.follow(menu_.edits().clicks().voxels, [&](const glm::ivec3& ijk, assets::VoxelLabel now) {
    views_.takeVoxel(ijk, now.label, now.tooth);
    changed.take(ijk);
  });
  // What would have to be taken back was long ago: found anew, it is painted anew.
  if (!could && !search_->isBusy()) {
    shown_.reset();
    search_->ask(*asked_);
  }
  page_.changed(changed);
}

void CheckRun::step() {
  // What is under the hand is not taken from it.
  if (search_ && !stroke_.isDrawn() && !canal_.isHeld())
    if (auto answer = search_->take()) {
      is_changed_ = true;
      if (answer->refusal.empty()) {
        if (answer->halves) canal_.take(std::move(*answer->halves));
        painted_.take(std::move(answer->jaw));
        shown_.reset();
        if (answer->is_whole) shown_ = std::move(answer->clicks);
        painted_.follow(menu_.edits().clicks().voxels, [](const glm::ivec3&, assets::VoxelLabel) {});
        page_.changed(views_.take(whatOf(found().label, found().tooth)));
        showFound();
        if (answer->is_whole)
          report_(fmt::format("shown: {} teeth, {} canals", found().teeth.size(), found().canals.size()));
      } else if (menu_.edits().done() > 0) {
        report_(answer->refusal);
        menu_.refuseLast(ofTheLastClick(answer->refusal));
        askIfChanged();
        showFound();
      } else {
        report_(answer->refusal);
        menu_.say(answer->refusal, true);
      }
    }
  if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    const Saved saved = saving_.get();
    is_changed_ = true;
    if (saved.trouble.empty()) {
      menu_.saved();
      keepLog(true);
    }
    menu_.say(saved.trouble.empty() ? saved.words : saved.trouble, !saved.trouble.empty());
    report_(menu_.message());
  }
  menu_.setBusy(isBusy());
}

bool CheckRun::isBusy() const { return isSaving() || (search_ && search_->isBusy()); }

void CheckRun::finish() {
  while (isBusy()) {
    step();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  step();
}

void CheckRun::save() {
  saving_ = std::async(std::launch::async, [this, patient = patient_, jaw = found(), edits = menu_.edits()]() mutable {
    try {
      const assets::Patient checked = checkedPatient(std::move(patient), std::move(jaw), edits);
      const auto statement = assets::savePatientAgain(checked, folder_, jawClicksText(edits.clicks()));
      keepCheckPicture(checked, folder_);
      return Saved{wordsOnSaved(statement), ""};
    } catch (const std::exception& error) {
      return Saved{"", calibration::withoutTemporaryNames(error.what())};
    }
  });
  saving_since_ = std::chrono::steady_clock::now();
  menu_.say("saving", false);
}

void CheckRun::review() {
  try {
    assets::reviewStatement(folder_);
    menu_.say("deidentified.toml says now that a person has looked at the pictures", false);
  } catch (const std::exception& error) {
    menu_.say(calibration::withoutTemporaryNames(error.what()), true);
  }
  report_(menu_.message());
}

bool CheckRun::answer(CheckMenu::Answer answer) {
  is_changed_ = true;
  menu_.setSide(views_.isRight(menu_.cursor_P_mm()));
  if (answer == CheckMenu::Answer::leave) return false;
  if (answer == CheckMenu::Answer::save && !isBusy()) save();
  if (answer == CheckMenu::Answer::reviewed) review();
  // Words on a canal change the lights alone.
  askIfChanged();
  showFound();
  return true;
}

/// What would change what is being saved, or leave it. Tools are taken, and places looked at, meanwhile.
bool CheckRun::isEdit(const render::WindowEvent& event, glm::ivec2 window_px) const {
  if (const auto* const letter = std::get_if<render::LetterTyped>(&event))
    return letter->letter == U'u' || letter->letter == U'U';
  if (const auto* const key = std::get_if<render::KeyPressed>(&event))
    return key->down && (key->control || key->key == render::Key::enter || key->key == render::Key::erase ||
                         key->key == render::Key::escape);
  const auto* const button = std::get_if<render::ButtonPressed>(&event);
  if (button == nullptr || !button->down || button->button != render::MouseButton::left) return false;
  const auto place = page_.placeAt(menu_, pointer_px_, window_px);
  if (!place) return false;
  return std::holds_alternative<CheckAction>(*place) ||
         (std::holds_alternative<ViewPlace>(*place) && menu_.tool() != CheckTool::look);
}

bool CheckRun::handle(const render::WindowEvent& event, glm::ivec2 window_px) {
  if (std::holds_alternative<render::CloseRequested>(event))
    return answer(menu_.take({.key = render::Key::escape, .down = true}));
  if (isSaving() && isEdit(event, window_px)) {
    menu_.say("it is being saved: one moment", false);
    return true;
  }
  if (const auto* const moved = std::get_if<render::PointerMoved>(&event)) {
    pointer_px_ = moved->to_px;
    const glm::dvec2 in_view_px = pointer_px_ - page_.cornerOf(held_view_, window_px);
    const glm::ivec2 view_px = page_.sizeOf(held_view_, window_px);
    if (stroke_.isDrawn()) {
      stroke_.moveTo(in_view_px, view_px);
    } else if (canal_.isHeld()) {
      const JawViews::Plane plane = views_.planeOf(held_view_, menu_.cursor_P_mm(), page_.look, view_px);
      canal_.moveTo(plane.at(in_view_px), plane.normal_P());
    } else {
      drag(*moved);
    }
    if (menu_.tool() == CheckTool::brush || canal_.isHeld()) is_changed_ = true;
  }
  if (const auto* const wheel = std::get_if<render::WheelTurned>(&event)) turnWheel(wheel->notches, window_px);
  if (const auto* const letter = std::get_if<render::LetterTyped>(&event)) {
    if (letter->letter == U'w' || letter->letter == U'W') {
      // Bone and teeth, teeth alone, soft tissue.
      static constexpr std::array kRanges{GreyRange{}, GreyRange{600.0, 3200.0}, GreyRange{-250.0, 450.0}};
      range_ = (range_ + 1) % kRanges.size();
      page_.range = kRanges[range_];
    }
    menu_.type(letter->letter);
    return answer(CheckMenu::Answer::none);
  }
  if (const auto* const key = std::get_if<render::KeyPressed>(&event)) {
    // Work that is not wanted any more ends with the edit that asked for it.
    if (key->down && key->key == render::Key::escape && search_ && search_->isBusy() && menu_.edits().done() > 0 &&
        !menu_.asks() && menu_.pending().empty() && painted_.isFound() && !menu_.edits().lastIsPainted()) {
      search_->leaveIt();
      menu_.refuseLast("stopped");
      return answer(CheckMenu::Answer::none);
    }
    const auto view = viewUnder(pointer_px_, window_px);
    const bool is_slice = view && view->view != JawView::solid && view->view != JawView::panoramic;
    if (key->down && key->key == render::Key::erase && menu_.tool() == CheckTool::canal && is_slice &&
        canal_.removeAt(found().canals, view->at_px, inView(view->view, window_px)))
      return answer(CheckMenu::Answer::none);
    return answer(menu_.take(*key));
  }
  if (const auto* const button = std::get_if<render::ButtonPressed>(&event);
      button != nullptr && button->button == render::MouseButton::left)
    button->down ? press(pointer_px_, window_px) : release(pointer_px_, window_px);
  return true;
}

void CheckRun::clickIn(const ViewPlace& place, glm::ivec2 window_px) {
  const auto p =
      views_.pointAt(place.view, menu_.cursor_P_mm(), page_.look, page_.sizeOf(place.view, window_px), place.at_px);
  if (p) {
    // What is clicked is what the list and the brush mean from then on.
    menu_.selectTooth(views_.whatAt(*p));
    menu_.clickAt(*p, views_.isRight(*p));
  }
  answer(CheckMenu::Answer::none);
}

std::optional<ViewPlace> CheckRun::viewUnder(const glm::dvec2& at_px, glm::ivec2 window_px) const {
  const auto place = page_.placeAt(menu_, at_px, window_px);
  const auto* const view = place ? std::get_if<ViewPlace>(&*place) : nullptr;
  return view != nullptr ? std::optional(*view) : std::nullopt;
}

HeldCanal::InView CheckRun::inView(JawView view, glm::ivec2 window_px) const {
  const glm::ivec2 px = page_.sizeOf(view, window_px);
  if (view == JawView::panoramic)
    return [this, px](const glm::dvec3& p_P_mm) {
      const auto at_px = views_.inPanoramic(p_P_mm, px);
      return at_px ? glm::dvec3(*at_px, 0.0) : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    };
  const JawViews::Plane plane = views_.planeOf(view, menu_.cursor_P_mm(), page_.look, px);
  return [plane](const glm::dvec3& p_P_mm) { return plane.of(p_P_mm); };
}

void CheckRun::press(const glm::dvec2& at_px, glm::ivec2 window_px) {
  const auto place = page_.placeAt(menu_, at_px, window_px);
  if (!place) return;
  if (const auto* const view = std::get_if<ViewPlace>(&*place)) {
    const bool is_slice = view->view != JawView::solid && view->view != JawView::panoramic;
    if (menu_.tool() == CheckTool::canal && is_slice &&
        canal_.press(found().canals, view->at_px, inView(view->view, window_px))) {
      held_view_ = view->view;
    } else if (menu_.tool() == CheckTool::brush && is_slice) {
      held_view_ = view->view;
      stroke_.begin(*view, page_.sizeOf(view->view, window_px));
    } else if (view->view == JawView::solid)
      pressed_px_ = at_px, is_dragged_ = false;
    else if (const auto end = menu_.tool() == CheckTool::canal
                                  ? canal_.proposedEndAt(found().canals, view->at_px, inView(view->view, window_px))
                                  : std::nullopt) {
      // The end as it was proposed, which may lie beside the slice.
      menu_.clickAt(*end, views_.isRight(*end));
      answer(CheckMenu::Answer::none);
    } else
      clickIn(*view, window_px);
    return;
  }
  if (const auto* const row = std::get_if<RowPlace>(&*place)) menu_.select(row->row);
  if (const auto* const tool = std::get_if<CheckTool>(&*place)) menu_.choose(*tool);
  const auto* const action = std::get_if<CheckAction>(&*place);
  answer(action != nullptr ? menu_.act(*action) : CheckMenu::Answer::none);
}

void CheckRun::release(const glm::dvec2& at_px, glm::ivec2 window_px) {
  if (stroke_.isDrawn() || canal_.isHeld()) {
    stroke_.isDrawn() ? stroke_.end() : canal_.release();
    answer(CheckMenu::Answer::none);
    return;
  }
  const bool was_pressed = std::exchange(pressed_px_, std::nullopt).has_value();
  if (!was_pressed || is_dragged_) return;
  const auto place = page_.placeAt(menu_, at_px, window_px);
  if (place)
    if (const auto* const view = std::get_if<ViewPlace>(&*place)) clickIn(*view, window_px);
}

void CheckRun::drag(const render::PointerMoved& moved) {
  if (moved.button == render::MouseButton::right) {
    page_.range.low_hu += kHuPerPx * moved.by_px.y;
    page_.range.high_hu =
        std::max(page_.range.low_hu + 100.0, page_.range.high_hu + kHuPerPx * (moved.by_px.x + moved.by_px.y));
    is_changed_ = true;
  }
  if (!pressed_px_) return;
  if (glm::distance(*pressed_px_, moved.to_px) > kClick_px) is_dragged_ = true;
  if (!is_dragged_) return;
  page_.look.turn_rad -= kTurn_rad_per_px * moved.by_px.x;
  page_.look.tilt_rad =
      std::clamp(page_.look.tilt_rad + kTurn_rad_per_px * moved.by_px.y, -kMostTilt_rad, kMostTilt_rad);
  is_changed_ = true;
}

void CheckRun::turnWheel(double notches, glm::ivec2 window_px) {
  const auto place = page_.placeAt(menu_, pointer_px_, window_px);
  if (!place) return;
  is_changed_ = true;
  const auto* const view = std::get_if<ViewPlace>(&*place);
  if (view == nullptr) {
    if (std::holds_alternative<RowPlace>(*place))
      menu_.take({.key = notches > 0.0 ? render::Key::up : render::Key::down, .down = true});
    return;
  }
  if (view->view == JawView::solid) {
    page_.look.zoom = std::clamp(page_.look.zoom * std::pow(1.15, notches), 1.0, 6.0);
    return;
  }
  if (view->view == JawView::panoramic) return;
  const glm::ivec2 px = page_.sizeOf(view->view, window_px);
  const glm::dvec3 normal = views_.planeOf(view->view, menu_.cursor_P_mm(), page_.look, px).normal_P();
  menu_.moveCursor(menu_.cursor_P_mm() + notches * views_.grid().spacing_mm * normal);
}

glm::dvec2 CheckRun::placeOf(JawView view, const glm::dvec3& p_P_mm, glm::ivec2 window_px) const {
  return page_.cornerOf(view, window_px) + glm::dvec2(inView(view, window_px)(p_P_mm));
}

/// As it is shown now, saved or not.
std::string CheckRun::title() const {
  if (!may_edit_) return patient_.shownTitle();
  const int operated = patient_.operatedTooth();
  const bool is_open = std::ranges::any_of(menu_.rows(), [&](const CheckRow& row) {
    const bool counts = row.kind == CheckRow::Kind::tooth ? row.fdi == operated
                                                          : row.is_there && row.is_right == assets::isRight(operated);
    return counts && row.light == Light::open;
  });
  return patient_.title + (is_open ? std::string(assets::kNotConfirmedTitle) : "");
}

render::Image CheckRun::picture(glm::ivec2 window_px) {
  CheckProgress progress;
  if (search_ && search_->isBusy()) progress = {search_->stage(), search_->seconds()};
  if (isSaving()) progress = {"saving", secondsSince(saving_since_), false};
  CheckHand hand;
  if (menu_.tool() == CheckTool::brush) hand.brush = viewUnder(pointer_px_, window_px);
  if (menu_.tool() == CheckTool::canal) {
    const auto points = canal_.points(found().canals);
    hand.canal_points.assign(points.begin(), points.end());
    hand.drawn_P_mm = canal_.line_P_mm();
  }
  return page_.picture(menu_, found().canals, title(), progress, hand, window_px);
}

}  // namespace app

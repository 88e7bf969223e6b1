// The check page at work, without a window: a patient folder, its views, list and edits, the search that makes teeth
// and canals of them, the log that keeps them, and saving. Events and pictures go in and out as values, so that tests
// drive it as a window does. Main thread; searching and saving have threads of their own.
//
// Every edit is written beside the folder (PATIENT.check.json) before it is computed: a kill, or leaving without
// saving, loses nothing, and the next time they are there again. Saving replaces the folder as a whole.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/check_page/check_menu.h"
#include "app/check_page/check_page.h"
#include "app/check_page/drawn_stroke.h"
#include "app/check_page/held_canal.h"
#include "app/check_page/jaw_search.h"
#include "app/check_page/painted_jaw.h"
#include "app/text/message.h"
#include "assets/patient.h"

namespace app {

/// Of a patient folder.
std::string checkLogPath(const std::string& folder);

class CheckRun {
 public:
  /// Throws LoadError: no such patient, and what of it cannot be read.
  CheckRun(std::string folder, ReportLine report);
  ~CheckRun();
  CheckRun(const CheckRun&) = delete;
  CheckRun& operator=(const CheckRun&) = delete;

  /// False: to be left.
  bool handle(const render::WindowEvent& event, glm::ivec2 window_px);
  /// Takes what has been found or saved meanwhile.
  void step();
  /// Waits until everything asked for is shown and saved.
  void finish();
  /// Something changes on the page by itself.
  bool isBusy() const;
  /// It is to be drawn again.
  bool takeChanged() { return std::exchange(is_changed_, false) || isBusy(); }

  /// Of what is shown, saved or not.
  std::string title() const;
  render::Image picture(glm::ivec2 window_px);

  const CheckMenu& menu() const { return menu_; }
  const JawViews& views() const { return views_; }
  const assets::JawSegmentation& found() const { return painted_.jaw(); }
  /// In the window, for a place in the scan: of the view's slice through the cursor.
  glm::dvec2 placeOf(JawView view, const glm::dvec3& p_P_mm, glm::ivec2 window_px) const;

 private:
  struct Saved {
    std::string words, trouble;  ///< one of them
  };

  void press(const glm::dvec2& at_px, glm::ivec2 window_px);
  void release(const glm::dvec2& at_px, glm::ivec2 window_px);
  void drag(const render::PointerMoved& moved);
  void turnWheel(double notches, glm::ivec2 window_px);
  bool answer(CheckMenu::Answer answer);
  bool isEdit(const render::WindowEvent& event, glm::ivec2 window_px) const;
  void clickIn(const ViewPlace& place, glm::ivec2 window_px);
  void askIfChanged();
  /// Strokes and cuts in force.
  void paintIfChanged();
  HeldCanal::InView inView(JawView view, glm::ivec2 window_px) const;
  std::optional<ViewPlace> viewUnder(const glm::dvec2& at_px, glm::ivec2 window_px) const;
  void showFound();
  void keepLog(bool is_saved);
  void save();
  /// A person says that the pictures name nobody; about 1 s per GB of the volume.
  void review();
  bool isSaving() const { return saving_.valid(); }

  std::string folder_;
  ReportLine report_;
  assets::Patient patient_;
  bool may_edit_ = false;
  JawViews views_;
  CheckMenu menu_;
  CheckPage page_;
  PaintedJaw painted_;
  DrawnStroke stroke_;
  HeldCanal canal_;
  std::optional<assets::JawClicks> asked_, shown_;  ///< clicks on teeth and canals
  CheckEdits logged_;
  bool was_logged_saved_ = true;
  std::optional<glm::dvec2> pressed_px_;  ///< in the view in three dimensions
  bool is_dragged_ = false, is_changed_ = true, is_log_lost_ = false;
  glm::dvec2 pointer_px_{-1.0};
  JawView held_view_ = JawView::axial;
  std::size_t range_ = 0;  ///< of grey values that are shown
  std::future<Saved> saving_;
  std::chrono::steady_clock::time_point saving_since_{};
  std::unique_ptr<JawSearch> search_;
};

}  // namespace app

// What the technician sees and hears, as plain data: the text is complete and only has to be drawn, upright in the
// mirror. The stylus and its button are the only input, so every page states what a short press, a long press (0.8 s)
// and holding still do. Frame W, mm. Plain values; any thread. Sizes, colours and layout: page_text.h, page_scene.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/fit/target_plan.h"
#include "calibration/rig.h"
#include "calibration/verification/verdict.h"

namespace app {

enum class TargetState { pending, next, done, doubtful };

struct ShownTarget {
  calibration::Point<calibration::World> position_W;
  calibration::Vector<calibration::World> stylus_W;  ///< unit, from the tip to the handle
  TargetState state = TargetState::pending;
  std::string name;  ///< "5", as the message says it
};

/// How the stylus should be held at the next target, and how it is: two directions from the tip to the handle.
struct TiltCue {
  calibration::Vector<calibration::World> wanted_W, present_W;
  double off_deg = 0.0;
  bool met = false;
  std::string words;  ///< "lean it 20° to the left"; empty once met
};

/// What else is to be drawn in the plane z = 0, in the middle.
enum class WizardFigure {
  none,
  letter_f,            ///< upright and reading right if the screen's corners are right
  length_bar,          ///< horizontal, `bar_mm` long, with end marks
  upright_length_bar,  ///< the same, from below upwards
};

enum class Tone { info, good, reject };

struct ShownMessage {
  std::string text;
  Tone tone = Tone::info;
};

/// What presses do on this page; empty: nothing.
struct ButtonHelp {
  std::string short_press, long_press, hold_still;
};

struct ShownVerdict {
  calibration::Verdict verdict = calibration::Verdict::red;
  std::string sentence;  ///< the one sentence: "Good. Worst: back left low, 0.9 mm."
};

/// A line of the second page.
struct ShownValue {
  std::string what, value;  ///< "error, 95 of 100", "0.41 mm"
};

enum class WizardSound { ok, reject, next, done };

struct WizardView {
  std::string title;               ///< "Touch the pits"
  std::string sentence;            ///< the one thing to do
  std::vector<std::string> facts;  ///< to be read and compared: serial number, stylus tip, …
  std::string value;               ///< one number to be set, large: "63 mm"; empty: none
  std::vector<std::string> choices;
  std::optional<std::size_t> marked;  ///< of the choices
  ButtonHelp button;
  std::string practice_keys;  ///< how mouse and keys move a practice stylus; empty: a real one
  ShownMessage message;       ///< the last one; empty text: none

  bool inkwell = false;  ///< the stylus belongs in its inkwell now
  WizardFigure figure = WizardFigure::none;
  double bar_mm = 0.0;

  calibration::TargetKind target_kind = calibration::TargetKind::pit;
  /// True: crosses of the screen's plane, drawn the same for both eyes. False: in stereo, where they are.
  bool zero_parallax = false;
  std::vector<ShownTarget> targets;
  std::optional<calibration::Point<calibration::World>> tip_W;  ///< estimated now
  std::optional<TiltCue> tilt;
  double capture = 0.0;            ///< 0 to 1 while it is held still
  std::string count;               ///< "12 of 27"; empty: nothing is counted
  std::optional<double> progress;  ///< 0 to 1 of this page
  std::optional<double> time_left_s;

  std::optional<ShownVerdict> verdict;
  std::vector<ShownValue> numbers;  ///< the second page; empty unless it is asked for

  std::vector<WizardSound> sounds;  ///< since the last look; to be played once

  /// Screen and eyes as they are known by now: what is to be drawn through.
  calibration::ScreenCorners screen;
  calibration::Point<calibration::World> left_eye, right_eye;
};

}  // namespace app

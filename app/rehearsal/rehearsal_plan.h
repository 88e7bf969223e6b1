// A rehearsal as plain values: patient, devices, tools, display, recording. Made by a command before anything runs.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/device/pose_source.h"
#include "app/device/second_hand.h"
#include "app/evaluation/evaluation_desk.h"
#include "app/evaluation/spectator.h"
#include "app/procedure/coach/coach.h"
#include "app/procedure/preparation/tooth_paint.h"
#include "app/procedure/procedure.h"
#include "app/procedure/root_canal/apex_locator.h"
#include "app/procedure/steps/step_plan.h"
#include "app/session/drawn_plan_event.h"
#include "app/session/step_event.h"
#include "app/sound/played_sound.h"
#include "app/station/workstation.h"
#include "app/view/display_windows.h"
#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "assets/risk_structures.h"
#include "assets/soft_tissue_field.h"
#include "calibration/rig.h"
#include "haptics/device/pedal/foot_pedal.h"
#include "haptics/servo/command.h"
#include "render/frame.h"
#include "render/render_options.h"

namespace app {

/// A procedure that is followed step by step.
struct ProcedureSteps {
  StepPlan plan;
  Guidance guidance = Guidance::guided;
  Prediction prediction;  ///< what was computed, and the surgeon's from the command line
  bool asks = false;      ///< for the surgeon's, in the picture
};

struct RehearsalPlan {
  assets::Patient patient;
  std::vector<std::uint8_t> scanned_solid;  ///< of a continued rehearsal; empty: the patient's solid is as scanned
  /// Into the tooth, of a continued rehearsal; none: nothing is.
  std::optional<haptics::Filling::Volumes> laid;
  bool flap_closed = false;               ///< the patient's gum is whole, incision and flap are done by hand
  std::optional<assets::PlannedCut> cut;  ///< followed by scripted input, shown as layer "plan"
  bool shows_whole_operation = false;     ///< a scripted hand does, up to the stitches; no soft tissue is met
  assets::SoftTissueField soft_tissue;    ///< what the instrument can touch; empty: none
  assets::RiskStructures risks;           ///< what the bur is to keep off; empty: nothing is told
  std::string instruction;                ///< of a practice block, one line; empty: none
  bool is_assessed = false;               ///< nothing helps, all is recorded (session/assessment_event)
  bool shows_clearance = true;            ///< in the picture; it is recorded in any case
  bool sounds_clearance = false;          ///< told by tones
  calibration::Rig rig;
  std::optional<glm::dvec3> down_P;  ///< unit, along gravity; none: down in the picture
  bool view_can_turn = false;  ///< a desk without a measured rig, and the hand is not a device at a place of its own
  render::DisplayMode display = render::DisplayMode::mono;
  bool eyes_swapped = false;
  std::optional<render::Backend> backend;  ///< empty: automatic
  render::Frame first_frame;               ///< view mode, layers and quality to begin with; the rest is the rehearsal's
  std::string device = "mouse";            ///< its address
  std::optional<HandScript> hand_script;   ///< what a scripted hand does; none: what it does on such a patient
  DeviceOptions device_options;
  std::optional<OpenedDevice> opened;  ///< the real one of the address, where it is open already
  SessionCalibration calibration;      ///< of hand and eye, as stored in the session
  std::vector<std::string> remarks;    ///< on calibration and case: printed, shown to the instructor, recorded
  SecondHandPlan second_hand;
  haptics::Command command;
  std::vector<haptics::Tool> other_tools;  ///< for changes of tool, after the command's
  std::string parameters;  ///< settings file, applied whenever it changes; `command` holds the keys it leaves out
  Procedure* procedure = nullptr;                 ///< leads where there is one
  EvaluationDesk* evaluation = nullptr;           ///< sets and follows tasks where there is one
  Spectator* spectator = nullptr;                 ///< sees each frame of a rehearsal in real time
  std::optional<ProcedureSteps> procedure_steps;  ///< followed where there is one
  DrawnPlan drawn;                                ///< by the surgeon before; empty: nothing is drawn
  std::optional<CoachRules> coach;                ///< none: it is silent
  std::optional<haptics::PedalChoice> pedal;      ///< none: no pedal is searched for
  std::optional<double> rate_Hz;                  ///< none: the rate of a recorded pose source, else 1 kHz
  std::optional<double> seconds;                  ///< simulated time; a scripted hand ends by itself
  std::optional<Recording> recording;
  std::string snapshot, first_snapshot;  ///< PNG paths; `_left` and `_right` are put before the ending
  glm::ivec2 snapshot_px{1280, 800};
  std::optional<ApexLocator::Mode> locator;  ///< of a root-canal treatment; none: it lies in its drawer
  double paper_mm = 0.04;                    ///< articulating paper of a tooth preparation
  DrawnOutline outline;                      ///< of its task, on a practice block; no spots: none is drawn
  double face_window_mm = 0.0;
  Ticking ticking = Ticking::realtime;  ///< stepped: as fast as the machine can, not displayed
  bool headless = false, full_screen = false, overwrite = false;
  bool sound = true;                        ///< in real time with a window
  PlayedSound* played = nullptr;            ///< gets the sound as the card does
  bool head_up_line = true;                 ///< shown to begin with
  bool summary = true;                      ///< printed at the end; else only where it was recorded
  bool verbose = false;                     ///< words for engineers on the terminal; force laws by key
  std::optional<int> monitor;               ///< index of render::monitors()
  bool instructor_window = false;           ///< on the next monitor, or next to the view
  std::optional<int> quality_step;          ///< held; none: by measured frame times
  std::unique_ptr<DisplayWindows> windows;  ///< opened while the patient was prepared, or null
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();  ///< start of the program

  glm::dvec3 gravity_P() const {
    return down_P.value_or(glm::conjugate(rig.X_WP.rotation) * glm::dvec3(0.0, -1.0, 0.0));
  }
};

}  // namespace app

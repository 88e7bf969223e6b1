// The options of `molar rehearse` as they are given, and their definition for the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/display_option.h"
#include "app/options/picture_option.h"
#include "app/procedure/preparation/bite.h"
#include "app/rehearsal/rehearsal_plan.h"
#include "app/station/rig_choice.h"
#include "app/text/command_line.h"
#include "assets/prepared_tooth.h"
#include "assets/synthetic/jaw.h"

namespace app {

struct RehearseOptions {
  RehearsalPlan plan;
  std::string patient, pedal = "auto", falcon_firmware, record, continued, face;
  bool no_record = false;
  RigOption rig;
  std::vector<std::string> tools{"round:3.0", "round:2.0", "fissure:1.6,4.5"};
  std::string shaft, law = "agus", preset, erosion = "time", size, snapshot_size = "1280x800";
  std::string pace = "real";
  std::string side = "right", second_tool = "mirror", case_name, procedure, guidance, predict, drawn, coach,
              flap = "raised";
  std::string task = "extraction", access = "closed", locator = "real", wear = "rate";
  std::string ideal;   ///< of a tooth preparation: a rule's name or a file; empty: as the caries asks for, else a crown
  std::string caries;  ///< of a tooth preparation; empty: none
  std::optional<assets::GivenIdeal> given_ideal;  ///< of the session that goes on
  std::string antagonist;                         ///< a file; empty: of the scan, else made
  std::string bite;                               ///< how the jaws close; empty: as the antagonist asks for
  std::string hinge;                              ///< BACK,UP; empty: the usual
  std::optional<assets::OpposingTeeth> opposing;  ///< of the session that goes on, with how the jaws close
  std::optional<assets::ToothBite> former_bite;
  std::string cavity = "uncut";      ///< ready: of a preparation, cut to its ideal
  double paper_um = kUsualPaper_um;  ///< of a tooth preparation
  std::optional<int> tooth;          ///< of a root-canal treatment or a preparation
  bool list_cases = false, assess = false;
  PictureOption picture;
  std::vector<std::string> settings;
  DisplayOption display;
  assets::JawParameters jaw;
  std::optional<double> face_window_mm, opening_mm;
  std::optional<std::string> position;
  std::optional<int> monitor;
  std::optional<double> loupes;
  bool no_line = false, no_sound = false;
  std::string clearance;
};

/// Adds them, in groups, with the keys; the values go to `options`, which must outlive the command.
void addRehearseOptions(CommandLine& command, RehearseOptions& options);

}  // namespace app

// The record of one servo tick: all inputs and outputs. Trivially copyable, fixed size; for the tick log, the session
// file, the status line and the renderer. Frame P; forces act on the hand.
#pragma once

#include <array>
#include <cstdint>

#include "assets/tissue.h"
#include "haptics/contact/soft_touch.h"
#include "haptics/safety/fault.h"
#include "haptics/safety/hand_sample.h"
#include "haptics/safety/safety_state.h"
#include "haptics/servo/chip_removal.h"
#include "haptics/servo/drill_inhibit.h"
#include "haptics/servo/file_work.h"
#include "haptics/servo/filling_work.h"
#include "haptics/servo/levering.h"
#include "haptics/servo/piece_sites.h"
#include "haptics/servo/tooth_break.h"
#include "haptics/servo/tooth_split.h"

namespace haptics {

struct Tick {
  std::uint64_t index = 0;  ///< from 0, without gaps
  double t_s = 0.0;         ///< simulated time at its start: the sum of the dt before it
  double dt_s = 0.0;
  std::uint64_t command_serial = 0;                                  ///< the Command in force
  HandSample hand;                                                   ///< input
  calibration::Point<calibration::Patient> proxy_P;                  ///< position of the bur at the surface
  calibration::Vector<calibration::Patient> law_force_P_N;           ///< law and proxy, before the safety layer
  calibration::Vector<calibration::Patient> law_torque_P_Nmm;        ///< the same, about T's origin
  calibration::Vector<calibration::Patient> commanded_force_P_N;     ///< sent to the device
  calibration::Vector<calibration::Patient> commanded_torque_P_Nmm;  ///< the same, about the handle
  double energy_Nmm = 0.0;                                           ///< the hand has put in and may get back
  double spindle_rad_per_s = 0.0;                                    ///< about +z of T
  double overlap_mm3 = 0.0;                                          ///< of the bur at the proxy
  double depth_mm = 0.0;                                             ///< equivalent depth of the law at the proxy
  double removed_mm3 = 0.0;         ///< this tick, chips too, no filling; below 0 in undo
  double restored_total_mm3 = 0.0;  ///< since the start, by undo, less what was redone
  std::uint64_t bone_digest = 0;    ///< after this tick
  /// Since the start, by assets::Tissue, less what was restored.
  std::array<double, assets::kTissueCount> removed_total_mm3{};
  std::uint8_t contact_tissue = 0;  ///< label with the largest overlap
  SoftTouch soft;                   ///< lip, cheek, tongue, gingiva: assets::kSoftTissues
  bool drilling = false;
  DrillInhibit drill_inhibit = DrillInhibit::none;              ///< why not drilling
  std::uint8_t strokes = 0;                                     ///< that can be undone
  std::uint8_t undone_strokes = 0;                              ///< that can be redone
  std::uint8_t pieces = 0;                                      ///< of the tooth; 0: none of its own
  SplitAnswer split = SplitAnswer::none;                        ///< to the newest Command::split
  BreakAnswer bridge = BreakAnswer::none;                       ///< to the newest Command::bridge
  BrokenBridge broken;                                          ///< in this tick
  double bridge_share = 0.0;                                    ///< of what breaks the bridge under load
  SiteAnswer site = SiteAnswer::none;                           ///< to the newest Command::site
  ChipAnswer chips = ChipAnswer::none;                          ///< to the newest Command::chips
  std::uint8_t gripped = 0;                                     ///< 1 + the piece that the forceps hold; 0: none
  bool set_aside = false;                                       ///< a piece was let go of outside, in this tick
  bool unsettled = false;                                       ///< the piece's balance was not found in this tick
  std::array<PiecePose, kMaxPieces> X_PQ{};                     ///< of the pieces, after this tick
  calibration::Vector<calibration::Patient> grip_force_P_N;     ///< on the piece, of the model
  calibration::Vector<calibration::Patient> grip_torque_P_Nmm;  ///< the same, about T's origin
  Levering lever;                                               ///< of an elevator
  double torn_share = 0.0;                                      ///< of the ligament of the piece held, or last held
  double torn_total_Nmm = 0.0;           ///< since the start, of all pieces, less what was undone
  FileWork file;                         ///< of a root-canal file
  FillingWork filling;                   ///< of what fills a tooth
  SafetyState state = SafetyState::off;  ///< force in `active` alone
  Fault faults = Fault::none;
  float work_us = 0.0f;  ///< CPU time of the step, for statistics; not replayed

  /// Attitude of the tool as held by soft tissue or by the piece it grips, drawn, felt and cut with at proxy_P.
  glm::dquat heldRotation() const { return soft.turn_P * hand.X_PT.rotation; }
};

}  // namespace haptics

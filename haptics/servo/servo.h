// The servo step: bodies, hand and command in, force out, jaw and tooth carved. A pure function of its state: no clock,
// I/O, allocation, lock, throw or log, so a session replays bit for bit. Frame P. Servo thread only. Per step: undo,
// proxy and law (at most 6 evaluations), delivery, carving; costs in haptics/README.
#pragma once

#include <utility>
#include <vector>

#include "haptics/body/bodies.h"
#include "haptics/safety/safety_layer.h"
#include "haptics/servo/chip_removal.h"
#include "haptics/servo/command.h"
#include "haptics/servo/cutting.h"
#include "haptics/servo/delivery.h"
#include "haptics/servo/filing.h"
#include "haptics/servo/filling_hand.h"
#include "haptics/servo/luxation.h"
#include "haptics/servo/piece_sites.h"
#include "haptics/servo/proxy.h"
#include "haptics/servo/root_canal_file.h"
#include "haptics/servo/soft_hold.h"
#include "haptics/servo/stroke_undo.h"
#include "haptics/servo/tear_pulses.h"
#include "haptics/servo/tick.h"
#include "haptics/servo/tooth_break.h"
#include "haptics/servo/tooth_split.h"

namespace haptics {

/// The command with every value in its range, and defaults for values that are not finite.
Command sanitised(const Command& command);

class Servo {
 public:
  /// Borrows bodies and soft tissue (null: none), which must outlive this; becomes the only writer of the bodies.
  /// Allocates the undo history.
  explicit Servo(Bodies& bodies, const assets::SoftTissueField* soft_tissue = nullptr)
      : bodies_(bodies),
        soft_tissue_(soft_tissue),
        filling_(bodies.filling()),
        canal_file_(bodies.fragments()),
        undo_(bodies) {}

  /// One tick of length `dt_s`. Invalid input is a Fault in the Tick.
  Tick step(const HandSample& hand, const Command& command, double dt_s) noexcept;

  /// All that is large: what undo and ligaments remember. A copy made while it is taken out costs 20 kB and goes on
  /// where this one was, once it is given the same bytes; bodies, sites and plans are shared with it. Not in a step.
  struct Memory {
    StrokeHistory::Memory strokes;
    std::vector<LuxationStrokes::Kept> luxations;
    std::vector<PieceMemory> waiting;
  };
  Memory takeMemory() noexcept {
    return {undo_.strokes().takeMemory(), undo_.luxations().takeMemory(), sites_.takeMemory()};
  }
  void giveMemory(Memory&& memory) noexcept {
    undo_.strokes().giveMemory(std::move(memory.strokes));
    undo_.luxations().giveMemory(std::move(memory.luxations));
    sites_.giveMemory(std::move(memory.waiting));
  }
  const PieceSites& sites() const { return sites_; }

 private:
  Bodies& bodies_;
  const assets::SoftTissueField* soft_tissue_;
  SafetyLayer safety_;
  SoftHold soft_hold_;
  Proxy proxy_;
  Cutting cutting_;
  Filing filing_;
  FillingHand filling_;
  RootCanalFile canal_file_;
  Delivery delivery_;
  StrokeUndo undo_;
  ToothSplit split_;
  ToothBreak breaks_;
  ChipRemoval chips_;
  PieceSites sites_;
  Luxation luxation_;
  TearPulses pulses_;
  double torn_before_Nmm_ = 0.0;
  bool broke_ = false;  ///< a bridge, in the last tick
  calibration::Pose<calibration::Patient, calibration::Tool> at_proxy_X_PT_;
  bool was_embedded_ = false, was_led_ = false;
  Tool tool_before_;          ///< of the last tick
  bool pedal_spent_ = false;  ///< until it is released
  std::uint64_t last_serial_ = 0;
  std::uint64_t next_index_ = 0;
  double t_s_ = 0.0;
};

}  // namespace haptics

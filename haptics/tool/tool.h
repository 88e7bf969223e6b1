// The tool in the hand: a head that cuts and is felt, and a shaft that is felt and never cuts. Frame T, mm. Trivially
// copyable, part of a Command; any thread. A handpiece behind it is touched by soft tissue only
// (instrument_outline.h).
#pragma once

#include "haptics/tool/bur_shape.h"
#include "haptics/tool/canal_file.h"
#include "haptics/tool/elevator_kind.h"
#include "haptics/tool/hand_instrument.h"

namespace haptics {

/// A round rod along +z from the origin of T to `length_mm`; its part inside the head counts as head. Length 0: none.
struct Shaft {
  double radius_mm = 0.0;
  double length_mm = 0.0;
  bool operator==(const Shaft&) const = default;
};

struct Tool {
  BurShape head;
  Shaft shaft;
  bool handpiece = true;  ///< false: the bur alone, for a hand that cannot turn it out of the way
  bool grips = false;     ///< forceps: the head is the place between the beaks, the pedal closes them, nothing turns
  ElevatorKind elevator = ElevatorKind::none;  ///< of this kind: T's origin is its blade's tip, nothing turns
  HandInstrument hand_instrument = HandInstrument::none;  ///< of this kind: nothing turns
  CanalFile file{};  ///< chosen: T's origin is its handle, nothing turns, the pedal opens the fingers (pliers)

  bool isElevator() const { return elevator != ElevatorKind::none; }
  /// Moves pieces of tooth: forceps or an elevator.
  bool luxates() const { return grips || isElevator(); }
  bool isHandInstrument() const { return hand_instrument != HandInstrument::none; }
  bool isFile() const { return file.isChosen(); }
  /// From T's origin to what works, along -z: 0 but for a file.
  double reach_mm() const { return isFile() && file.length_mm > 0.0 && file.length_mm <= 100.0 ? file.length_mm : 0.0; }
  /// A bur: the pedal turns it and it cuts.
  bool turns() const { return !luxates() && !isHandInstrument() && !isFile(); }
  bool operator==(const Tool&) const = default;
};

/// Head and shaft within their ranges; no shaft if it is invalid.
Tool sanitised(const Tool& tool) noexcept;

/// Extraction forceps: they meet bone and tooth between their beaks alone.
Tool forcepsTool() noexcept;

/// Until its blade works on a piece it meets bone and tooth with the tip and, if it is straight, the middle of blade
/// and shank (ligament/elevator_hold).
Tool elevatorTool(ElevatorKind kind) noexcept;

/// `kind` not none.
Tool handInstrumentTool(HandInstrument kind) noexcept;

/// A file made as ISO 3630-1 has it, or a cone of gutta-percha. Only what is stiff at its handle is held off by soft
/// tissue.
Tool fileTool(const CanalFile& file) noexcept;

/// The usual shaft of a bur: a shank of 2.35 mm (ISO 1797, type 2), or a neck narrower than the head that lets chips
/// out; 25 mm long, as far as it stands out of a handpiece.
Shaft standardShaft(const BurShape& head) noexcept;

}  // namespace haptics

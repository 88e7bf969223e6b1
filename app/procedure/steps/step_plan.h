// A procedure as data: steps in order, each with what the surgeon does, with which instruments, where, when it is done
// and what counts as an error. Read from TOML (step_file), followed by step_tracker. mm, mm³, N; shares 0..1. Amounts
// are those of the whole rehearsal as it stands, not of the step alone, so that work done early counts. Plain data.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace app {

/// Those up to `forceps` are in a rehearsal's tray; a hand that uses another of them than the step names errs.
enum class StepInstrument : std::uint8_t {
  bur,
  elevator,
  forceps,
  scalpel,
  periosteal_elevator,
  retractor,
  curette,
  bone_file,
  syringe,
  suction,
  needle_holder
};
inline constexpr std::array<std::string_view, 11> kStepInstruments = {
    "bur",     "elevator",  "forceps", "scalpel", "periosteal elevator", "retractor",
    "curette", "bone file", "syringe", "suction", "needle holder"};
inline std::string nameOf(StepInstrument instrument) {
  return std::string(kStepInstruments[static_cast<std::size_t>(instrument)]);
}

enum class StepRegion : std::uint8_t { none, flap, gutter, tooth, socket };
inline constexpr std::array<std::string_view, 5> kStepRegions = {"none", "flap", "gutter", "tooth", "socket"};

/// All that is said must hold. A step that is given holds by itself.
struct DoneWhen {
  std::string given;  ///< why it is not done by hand, for the surgeon; empty: it is
  std::optional<StepInstrument> in_hand;
  std::optional<double> incision_mm;          ///< down to the bone, at least
  std::optional<double> flap_raised;          ///< share of the gum over the planned cut
  bool flap_held = false;                     ///< aside
  std::optional<double> gutter_removed;       ///< share of the planned gutter's bone
  std::optional<double> crown_bared;          ///< share of the crown that the plan lays bare
  std::optional<double> bone_mm3, tooth_mm3;  ///< removed, at least
  std::optional<double> bridge_mm;  ///< thickness of what still holds the tooth together, at most; or it is parted
  std::optional<double> torn;       ///< share of the ligament of the piece held, or held last
  std::optional<int> pieces, pieces_out;  ///< at least
  bool all_out = false;                   ///< every piece
  // The socket, once a piece is out.
  std::optional<double> chips_mm3;      ///< loose in the mouth, at most
  std::optional<double> follicle_left;  ///< share, at most
  std::optional<double> edges_mm;       ///< sharp, at most
  bool socket_clean = false;            ///< as SocketRecord::isClean()
  std::optional<int> stitches;          ///< confirmed, at least

  bool asksForFlap() const { return incision_mm || flap_raised || flap_held; }
  bool hasRule() const {
    return asksForFlap() || in_hand || gutter_removed || crown_bared || bone_mm3 || tooth_mm3 || bridge_mm || torn ||
           pieces || pieces_out || all_out || chips_mm3 || follicle_left || edges_mm || socket_clean || stitches;
  }
};

/// What counts as an error in a step, once each time it begins.
struct StepErrorRules {
  bool neighbour = false, canal = false;  ///< touched by bur or beaks
  bool soft_tissue = false;               ///< the bur turns on it
  bool dry = false;                       ///< cutting without water
  bool fulcrum = false;                   ///< the elevator rests on another tooth
  bool wrong_instrument = false;          ///< used, and the step does not name it
  std::optional<double> nerve_mm;         ///< cutting nearer to the mandibular canal
  std::optional<double> cutting_N;        ///< of the model, more than that
  std::optional<double> pull_N;           ///< of the forceps on a piece, alike
  std::optional<double> bone_mm3;         ///< removed, more than that
};

struct Step {
  std::string key;  ///< of a to z, 0 to 9 and '-'; unique
  std::string title, instruction;
  std::vector<StepInstrument> instruments;
  StepRegion region = StepRegion::none;
  DoneWhen done_when;
  StepErrorRules errors;
};

struct StepPlan {
  std::string name;  ///< of a shipped one, or "own"
  std::string title;
  std::vector<Step> steps;  ///< not empty
};

/// For a rehearsal that begins with the flap raised: steps that ask for nothing else are given.
StepPlan withFlapRaised(StepPlan plan);

/// How much of it is told: nothing; the next step; nothing but the record of errors and times.
enum class Guidance : std::uint8_t { free, guided, assessed };
inline constexpr std::array<std::string_view, 3> kGuidances = {"free", "guided", "assessed"};

}  // namespace app

#include "app/rehearsal/warnings.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include <fmt/core.h>

#include "app/procedure/jaw_stress.h"
#include "app/procedure/root_canal/access_outcomes.h"
#include "app/procedure/root_stress.h"
#include "app/rehearsal/touches.h"
#include "assets/soft_tissue.h"
#include "assets/tooth.h"
#include "haptics/safety/trips.h"
#include "haptics/tool/bur_shape.h"

namespace app {
namespace {

using assets::SoftTissue;
using haptics::Fault;
using haptics::SafetyState;

constexpr double kStays_s = 0.8;       ///< after the cause is over
constexpr double kNearCanal_mm = 2.0;  ///< nerve at risk below it (reference/extraction)
constexpr double kShaftForce_N = 0.1;  ///< of a contact without the head
constexpr std::uint8_t kUsuallyHeld = assets::bitOf(SoftTissue::gingiva) | assets::bitOf(SoftTissue::flap);

using Words = std::string;  ///< empty: the warning does not apply

std::string sentence(std::string_view what, std::string_view next) {
  return std::string(what) + " " + std::string(next);
}

bool isOffForGood(SafetyState state) { return state == SafetyState::off || state == SafetyState::fault; }

Words forceIsOff(const Situation& s) {
  if (!s.has_motors || !isOffForGood(s.tick.state)) return {};
  const haptics::StateText& text = haptics::textOf(s.tick.state);
  return sentence(text.what, text.next);
}

Words noForceYet(const Situation& s) {
  if (!s.has_motors || s.command.hands_off || s.tick.state == SafetyState::active || isOffForGood(s.tick.state))
    return {};
  const haptics::StateText& text = haptics::textOf(s.tick.state);
  return sentence(text.what, text.next);
}

Words notRecording(const Situation& s) { return s.recording_ended ? "Not recording any more" : ""; }

Words canalOpened(const Situation& s) {
  const bool inside =
      assets::Tissue{s.tick.contact_tissue} == assets::Tissue::mandibular_canal && s.tick.overlap_mm3 > 0.0;
  return inside && s.tick.drilling ? "Mandibular canal opened" : "";
}

Words burOnSoftTissue(const Situation& s) {
  if (s.tick.soft.bur_cuts == SoftTissue::none) return {};
  return fmt::format("Bur cuts the {}", assets::properties(s.tick.soft.bur_cuts).name);
}

Words neighbourTouched(const Situation& s) {
  if (!s.neighbour) return {};
  return fmt::format("{} touched", assets::toothName(*s.neighbour));
}

Words leveredOnTeeth(const Situation& s) {
  return s.tick.lever.restsOnTeeth() ? "Elevator rests on a neighbouring tooth" : "";
}

Words jawAtRisk(const Situation& s) {
  if (!s.jaw_N_per_mm2 || *s.jaw_N_per_mm2 < JawStress::kDangerous_N_per_mm2) return {};
  return fmt::format("Jaw at risk, {:.0f} MPa: less force", *s.jaw_N_per_mm2);
}

Words jawStressed(const Situation& s) {
  if (!s.jaw_N_per_mm2 || *s.jaw_N_per_mm2 < JawStress::kHigh_N_per_mm2 ||
      *s.jaw_N_per_mm2 >= JawStress::kDangerous_N_per_mm2)
    return {};
  return fmt::format("Jaw stressed, {:.0f} MPa", *s.jaw_N_per_mm2);
}

Words rootAtRisk(const Situation& s) {
  if (!s.root_N_per_mm2 || *s.root_N_per_mm2 < RootStress::kBreaks_N_per_mm2) return {};
  return fmt::format("{} would break, {:.0f} MPa: loosen it first", s.is_crown ? "Crown" : "Root", *s.root_N_per_mm2);
}

Words rootStressed(const Situation& s) {
  if (!s.root_N_per_mm2 || *s.root_N_per_mm2 < RootStress::kHigh_N_per_mm2 ||
      *s.root_N_per_mm2 >= RootStress::kBreaks_N_per_mm2)
    return {};
  return fmt::format("{} stressed, {:.0f} of {:.0f} MPa", s.is_crown ? "Crown" : "Root", *s.root_N_per_mm2,
                     RootStress::kBreaks_N_per_mm2);
}

Words dry(const Situation& s) {
  const bool cuts = s.tick.drilling && s.tick.depth_mm > 0.0;
  return cuts && !s.command.irrigating ? "Cutting dry: water on with I" : "";
}

Words canalNear(const Situation& s) {
  if (!s.canal_mm || *s.canal_mm >= kNearCanal_mm) return {};
  return fmt::format("Nerve {:.1f} mm", std::max(0.0, *s.canal_mm));
}

Words softTissuePressed(const Situation& s) {
  if ((s.tick.soft.tissues & ~kUsuallyHeld) == 0 || s.tick.soft.bur_cuts != SoftTissue::none) return {};
  std::string names;
  for (std::size_t n = 1; n < assets::kSoftTissueCount; ++n) {
    const auto tissue = static_cast<SoftTissue>(n);
    if ((assets::bitOf(tissue) & ~kUsuallyHeld) == 0 || !assets::contains(s.tick.soft.tissues, tissue)) continue;
    names += (names.empty() ? "" : ", ") + std::string(assets::properties(tissue).name);
  }
  return names.empty() ? names : names + " touched";
}

Words drillHeldBack(const Situation& s) {
  switch (s.tick.drill_inhibit) {
    case haptics::DrillInhibit::tool_embedded:
      return "Withdraw the bur: no force until it is out of the bone";
    case haptics::DrillInhibit::pedal_held:
      return "Release the pedal to drill again";
    default:
      return {};
  }
}

Words forceLimited(const Situation& s) {
  if (!s.has_motors) return {};
  if (has(s.tick.faults, Fault::hot)) return "Motors warm: press less or rest";
  if (has(s.tick.faults, Fault::too_fast | Fault::braked)) return "Move more slowly";
  return has(s.tick.faults, Fault::clamped | Fault::joints) ? "Force at the device's limit: press less" : "";
}

Words neckTouches(const Situation& s) {
  const bool force_without_head = s.tick.depth_mm <= 0.0 && glm::length(s.tick.law_force_P_N.xyz) > kShaftForce_N;
  return force_without_head && s.command.tool.turns() && !s.tick.soft.touches() ? "The bur's neck touches" : "";
}

constexpr double kNearBreaking = 0.7;

Words fileNearBreaking(const Situation& s) {
  if (s.tick.file.torque_share < kNearBreaking) return {};
  return fmt::format("The file bears {:.0f} % of what breaks it: turn back", 100.0 * s.tick.file.torque_share);
}

Words fileThrough(const Situation& s) {
  return s.tick.file.stay == haptics::FileStay::through ? "Draw the file out: no force until it is out of the tooth"
                                                        : "";
}

Words atChamberFloor(const Situation& s) {
  if (!s.below_cusp_mm || depthBand(*s.below_cusp_mm) != DepthBand::red) return {};
  return fmt::format("{:.1f} mm below the cusp: the chamber's floor lies at 8", *s.below_cusp_mm);
}

Words atChamberRoof(const Situation& s) {
  if (!s.below_cusp_mm || depthBand(*s.below_cusp_mm) != DepthBand::amber) return {};
  return fmt::format("{:.1f} mm below the cusp: the chamber's roof lies at 6.4", *s.below_cusp_mm);
}

struct Row {
  const char* name;  ///< in the summary
  bool danger;
  Words (*words)(const Situation&);
  bool is_counted_as_touch = false;  ///< by tick: touches.h, app/session/soft_touches.h
};

// The most important first.
constexpr std::array<Row, 21> kTable = {{
    {"force off", true, forceIsOff},
    {"mandibular canal opened", true, canalOpened},
    {"bur on soft tissue", true, burOnSoftTissue, true},
    {"neighbour tooth touched", true, neighbourTouched, true},
    {"jaw at risk", true, jawAtRisk},
    {"root or crown would break", true, rootAtRisk},
    {"elevator on a neighbouring tooth", true, leveredOnTeeth},
    {"file near breaking", true, fileNearBreaking},
    {"bur as deep as the chamber's floor", true, atChamberFloor},
    {"recording ended", true, notRecording},
    {"no force yet", false, noForceYet},
    {"within 2 mm of the nerve", false, canalNear},
    {"bur as deep as the chamber's roof", false, atChamberRoof},
    {"jaw stressed", false, jawStressed},
    {"root or crown stressed", false, rootStressed},
    {"cutting dry", false, dry},
    {"soft tissue touched", false, softTissuePressed, true},
    {"drill held back", false, drillHeldBack},
    {"file held back", false, fileThrough},
    {"force limited", false, forceLimited},
    {"neck of the bur touched", false, neckTouches},
}};

/// Not told where distances are not.
bool isDistance(Words (*words)(const Situation&)) {
  return words == canalNear || words == atChamberRoof || words == atChamberFloor;
}

/// A tooth other than the operated one that the bur touches.
std::optional<int> neighbourAt(const haptics::Tick& tick, const haptics::BurShape& head,
                               const assets::Patient& patient) {
  for (const int fdi : teethTouched(tick, head, patient))
    if (fdi != patient.operatedTooth()) return fdi;
  return {};
}

}  // namespace

Situation situationOf(const haptics::Tick& tick, const haptics::Command& command, const assets::Patient& patient,
                      bool has_motors, bool recording_ended) {
  const haptics::BurShape& head = command.tool.head;
  // A hand instrument that touches a tooth harms nothing.
  const auto neighbour =
      !command.tool.turns() && !command.tool.luxates() ? std::nullopt : neighbourAt(tick, head, patient);
  return {tick, command, has_motors, recording_ended, neighbour};
}

std::vector<HeadUpWarning> Warnings::update(const Situation& now) {
  static_assert(kTable.size() == kRows);
  std::vector<HeadUpWarning> shown;
  const double now_s = now.tick.t_s;
  for (std::size_t n = 0; n < kTable.size(); ++n) {
    State& state = states_[n];
    if (now_s < state.last_s) state.last_s = -1e9;
    const bool was_shown = now_s - state.last_s <= kStays_s;
    if (std::string words = kTable[n].words(now); !words.empty()) {
      words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
      if (!was_shown) ++state.times;
      state.words = std::move(words);
      state.last_s = now_s;
    }
    if (now_s - state.last_s <= kStays_s && !(now.is_blind && isDistance(kTable[n].words)))
      shown.push_back({state.words, kTable[n].danger});
  }
  std::ranges::stable_partition(shown, &HeadUpWarning::danger);
  return shown;
}

std::vector<Warnings::Count> Warnings::counts() const {
  std::vector<Count> counts;
  for (std::size_t n = 0; n < kTable.size(); ++n)
    if (states_[n].times > 0 && !kTable[n].is_counted_as_touch) counts.push_back({kTable[n].name, states_[n].times});
  return counts;
}

}  // namespace app

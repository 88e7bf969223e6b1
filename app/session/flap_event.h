// The flap of a rehearsal that began with the gum closed, as an event of a recording: incision, what was raised, what
// went wrong. Written when it changes; the last one stands for the session. mm. Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace app {

/// Kind of these events.
inline constexpr char kFlapEvent[] = "flap";

struct FlapRecord {
  double incision_mm = 0.0;            ///< length
  double full_share = 0.0;             ///< of it, down to the bone
  std::optional<double> lingual_mm;    ///< least distance to the ridge's edge at the tongue; below 0: beyond it
  double beyond_lingual_mm = 0.0;      ///< length of the incision beyond that edge
  double limb_mm = 0.0;                ///< of a releasing cut; 0: an envelope flap
  std::optional<bool> papilla_spared;  ///< in front of the second molar, by the releasing cut
  double raised_share = 0.0;           ///< of the gum over the planned cut
  double raised_mm2 = 0.0;             ///< in all
  int tears = 0, slips = 0, bur_touches = 0;
  bool is_held = false;      ///< aside, by the assistant's retractor
  std::uint64_t digest = 0;  ///< of the sheet, for a comparison of two runs

  bool operator==(const FlapRecord&) const = default;
};

/// Longer, it releases a flap: a triangular one.
inline constexpr double kLeastLimb_mm = 4.0;

/// One line of JSON.
std::string flapText(const FlapRecord& flap);
/// None of other words, and of numbers that are not finite or out of their range.
std::optional<FlapRecord> flapFrom(const std::string& text);
/// "triangular, incision 41 mm, 97 % to the bone; raised 98 % of what the plan bares; held; 1 tear".
std::string flapInWords(const FlapRecord& flap);

}  // namespace app

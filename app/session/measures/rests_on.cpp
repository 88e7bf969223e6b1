#include "app/session/measures/rests_on.h"

#include <algorithm>
#include <array>

namespace app {

assets::Proposed restsOn(std::string_view id) {
  constexpr assets::Proposed kNothing, kTooth{true, false}, kCanal{false, true};
  // The envelope of S6 is by distance to the canal.
  if (id.starts_with("S6.")) return kCanal;
  constexpr std::array<std::string_view, 5> kNear{"S1.", "S2.", "S3.", "S4.", "S5."};
  if (std::ranges::any_of(kNear, [&](std::string_view one) { return id.starts_with(one); }))
    return id.find("canal") != std::string_view::npos ? kCanal : kTooth;
  if (id.starts_with("O") || id.starts_with("S8.") || id == "M9.planned_size") return kTooth;
  // Of the tooth as a body of its own, and by label.
  constexpr auto kOfTooth = std::to_array<std::string_view>(
      {"grip_s", "max_grip_N", "lever_s", "max_lever_Nmm", "max_fulcrum_N", "ligament_torn_Nmm", "pieces_out",
       "bridges_broken", "removed_mm3_by_label", "bridge_breaks", "way_out", "drawn_plan", "drawn_cut", "flap",
       "prediction", "root_canals", "perforation", "second_molar", "retained"});
  if (std::ranges::find(kOfTooth, id) != kOfTooth.end()) return kTooth;
  if (id == "canal") return kCanal;
  if (id == "socket" || id == "touched") return {true, true};
  return kNothing;
}

}  // namespace app

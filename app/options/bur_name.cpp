#include "app/options/bur_name.h"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/core.h>

namespace app {
namespace {

// In the order of haptics::ShapeKind.
constexpr std::array<std::string_view, 4> kShapes{"round", "round-end fissure", "fissure", "cone"};
// In the order of assets::BurProfile.
constexpr std::array<std::string_view, assets::kBurProfiles> kProfiles{
    "wheel", "inverted cone", "flat-end taper",    "round-end taper", "torpedo", "flame",
    "pear",  "egg",           "round-end cylinder"};
// In the order of haptics::ElevatorKind.
constexpr std::array<std::string_view, 5> kElevators{"none", "elevator 301", "elevator 34S", "Cryer elevator left",
                                                     "Cryer elevator right"};
// In the order of haptics::HandInstrument.
constexpr std::array<std::string_view, haptics::kHandInstrumentKeys.size()> kHandInstruments{
    "none",
    "scalpel no. 15",
    "periosteal elevator",
    "curette",
    "bone file",
    "suction tip",
    "applicator, composite",
    "applicator, glass ionomer",
    "amalgam carrier",
    "applicator, wax",
    "applicator, gutta-percha",
    "plugger",
    "carver",
    "curing lamp",
    "root-canal plugger, hot"};
constexpr double kSameSize = 0.02;  ///< tenths of a millimetre

}  // namespace

std::string burName(const haptics::BurShape& head) {
  const double diameter_mm = 2.0 * head.radius_mm, tenths = 10.0 * diameter_mm;
  const std::string_view shape = head.kind == haptics::ShapeKind::revolved
                                     ? kProfiles[static_cast<std::size_t>(head.profile)]
                                     : kShapes[static_cast<std::size_t>(head.kind)];
  if (std::abs(tenths - std::round(tenths)) > kSameSize) return fmt::format("{} {:.2f} mm", shape, diameter_mm);
  return fmt::format("{} {:.1f} mm, ISO {:03}", shape, diameter_mm, std::lround(tenths));
}

std::string toolName(const haptics::Tool& tool) {
  if (const auto cone = tool.file.cone())
    return fmt::format("gutta-percha cone {}, {:.0f} %{}", cone->size, 100.0 * cone->taper,
                       tool.file.sealer_mm3 > 0.0 ? "" : ", dry");
  if (const auto file = tool.file.made())
    return fmt::format("K-file {} {}, {:g} mm{}{}", file->size, file->colour(), file->length_mm,
                       tool.file.nickel_titanium ? ", NiTi" : "",
                       tool.file.bent_deg != 0.0 ? fmt::format(", bent {:g}°", tool.file.bent_deg) : "");
  if (tool.grips) return "extraction forceps";
  if (tool.isHandInstrument()) return std::string(kHandInstruments[static_cast<std::size_t>(tool.hand_instrument)]);
  return tool.isElevator() ? std::string(kElevators[static_cast<std::size_t>(tool.elevator)]) : burName(tool.head);
}

}  // namespace app

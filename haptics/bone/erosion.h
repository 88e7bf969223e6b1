// Erosion laws: how fast a turning bur removes tissue; the selected law and the parameters of all of them. Trivially
// copyable, part of a Command; may change every tick. What a law removes in a tick: bone/erosion_step. Tissue factors
// come from hardness, see assets::kTissues. Plain data and one static table; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "assets/tissue.h"
#include "haptics/tool/parameter_table.h"

namespace haptics {

enum class ErosionKind : std::uint8_t { time, dose, machining };

/// Intersection time (forssim; reference/physics 1.2): a covered voxel loses at one rate, independent of the force.
struct TimeErosion {
  double removal_rate_per_s = 4.0;  ///< fraction of a fully covered voxel of reference tissue, at `rated_rpm`
  double rated_rpm = 40000.0;       ///< in proportion to the spindle's speed
};

/// Friction power (Agus et al. 2002; reference/physics 1.1; with 1/alpha as Archard's wear, Chan et al. 2016, 1.6):
/// MRR = alpha mu F_n v_c. alpha = 1/u, u 0.3-4 J/mm3 for manual burring (reference/physics 4).
struct DoseErosion {
  double removal_mm3_per_J = 0.5;
};

/// Chip volume (Arbabtafti; reference/physics 1.5): the volume swept by the feed, limited by the spindle's power.
struct MachiningErosion {
  double cutting_energy_J_per_mm3 = 0.1;  ///< u = K_tc
};

struct ErosionSettings {
  ErosionKind kind = ErosionKind::time;
  TimeErosion time;
  DoseErosion dose;
  MachiningErosion machining;
  double friction = 0.3;  ///< mu of bur on bone, 0.2-0.5 (reference/physics 1.1): drives `dose`, loads the spindle
  double worn = 0.0;      ///< 0 a new bur .. 1 one that removes nothing
  std::array<double, assets::kTissueCount> tissue_factor = [] {
    std::array<double, assets::kTissueCount> factor{};
    for (std::size_t i = 0; i < factor.size(); ++i) factor[i] = assets::kTissues[i].removal_factor;
    return factor;
  }();
};

using ErosionName = LawEntry<ErosionKind>;
inline constexpr std::array<ErosionName, 3> kErosions = {{
    {ErosionKind::time, "time", "dV/dt = k f V w/w_rated", "a steady rate that needs no force: teaching, comparison"},
    {ErosionKind::dose, "dose", "dV/dt = alpha f mu F_n v_c", "pressing harder cuts faster, the tip of a bur hardly"},
    {ErosionKind::machining, "machining", "dV/dt = min(swept, f P/u)",
     "the hand's feed cuts until the motor is at its end"},
}};
std::optional<ErosionKind> erosionOfKey(std::string_view key);

using ErosionParameter = Parameter<ErosionSettings, ErosionKind>;
std::span<const ErosionParameter> erosionParameters();

/// Every parameter clamped to its range, defaults for NaN and infinity; the default law for an unknown one.
ErosionSettings sanitised(const ErosionSettings& settings);

}  // namespace haptics

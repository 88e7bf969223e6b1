// How fast tissue goes under a turning bur: which law, and the parameters of all of them side by side. Trivially
// copyable, part of a Command; may change from tick to tick. What each does in a tick: bone/erosion_step.
// The tissue factors come from hardness, see assets::kTissues. Plain data and one static table; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "assets/tissue.h"

namespace haptics {

enum class ErosionKind : std::uint8_t { time, dose, machining };

/// Intersection time (forssim; reference/physics 1.2): a covered voxel loses at one rate, whatever the hand presses.
struct TimeErosion {
  double removal_rate_per_s = 4.0;  ///< fraction of a fully covered voxel of reference tissue, at `rated_rpm`
  double rated_rpm = 40000.0;       ///< in proportion to the spindle's speed
};

/// Friction power (Agus et al. 2002; reference/physics 1.1; with 1/alpha as Archard's wear, Chan et al. 2016, 1.6):
/// MRR = alpha mu F_n v_c. alpha = 1/u, u 0.3-4 J/mm3 for burring by hand (reference/physics 4).
struct DoseErosion {
  double removal_mm3_per_J = 0.5;
};

/// Chip volume (Arbabtafti; reference/physics 1.5): what the feed sweeps, as far as the spindle's power goes.
struct MachiningErosion {
  double cutting_energy_J_per_mm3 = 0.1;  ///< u = K_tc
};

struct ErosionSettings {
  ErosionKind kind = ErosionKind::time;
  TimeErosion time;
  DoseErosion dose;
  MachiningErosion machining;
  double friction = 0.3;  ///< mu of bur on bone, 0.2-0.5 (reference/physics 1.1): pays for `dose`, loads the spindle
  double worn = 0.0;      ///< 0 a new bur .. 1 one that takes nothing
  std::array<double, assets::kTissueCount> tissue_factor = [] {
    std::array<double, assets::kTissueCount> factor{};
    for (std::size_t i = 0; i < factor.size(); ++i) factor[i] = assets::kTissues[i].removal_factor;
    return factor;
  }();
};

struct ErosionName {
  ErosionKind kind;
  std::string_view key;  ///< in files and on the command line
  std::string_view formula, good_for;
};
inline constexpr std::array<ErosionName, 3> kErosions = {{
    {ErosionKind::time, "time", "dV/dt = k f V w/w_rated", "a steady rate that needs no force: teaching, comparison"},
    {ErosionKind::dose, "dose", "dV/dt = alpha f mu F_n v_c", "pressing harder cuts faster, the tip of a bur hardly"},
    {ErosionKind::machining, "machining", "dV/dt = min(swept, f P/u)",
     "the hand's feed cuts until the motor is at its end"},
}};
std::optional<ErosionKind> erosionOfKey(std::string_view key);

struct ErosionParameter {
  std::optional<ErosionKind> law;  ///< none: every law obeys it
  std::string_view key;            ///< unique over all laws
  std::string_view unit;           ///< "" for a ratio
  double lowest, highest;
  std::string_view meaning;
  double& (*in)(ErosionSettings&);
};
std::span<const ErosionParameter> erosionParameters();

/// Every parameter within its range, its default where it is no number; the default law for one that does not exist.
ErosionSettings sanitised(const ErosionSettings& settings);

}  // namespace haptics

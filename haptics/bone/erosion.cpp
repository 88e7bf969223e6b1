#include "haptics/bone/erosion.h"

namespace haptics {
namespace {

constexpr std::string_view kFactor = "factor_";

using Row = ErosionParameter;
constexpr std::array kRows = {
    Row{ErosionKind::time, "removal_rate_per_s", "1/s", 0.0, 1000.0,
        "k: part of a covered voxel removed per second at the rated speed",
        valueIn<&ErosionSettings::time, &TimeErosion::removal_rate_per_s>},
    Row{ErosionKind::time, "rated_rpm", "rpm", 100.0, 400000.0, "w_rated: the speed k is stated for",
        valueIn<&ErosionSettings::time, &TimeErosion::rated_rpm>},
    Row{ErosionKind::dose, "removal_mm3_per_J", "mm3/J", 0.0, 100.0,
        "alpha: reference tissue removed per work of friction",
        valueIn<&ErosionSettings::dose, &DoseErosion::removal_mm3_per_J>},
    Row{ErosionKind::machining, "cutting_energy_J_per_mm3", "J/mm3", 0.001, 10.0, "u: work of cutting reference tissue",
        valueIn<&ErosionSettings::machining, &MachiningErosion::cutting_energy_J_per_mm3>},
    Row{std::nullopt, "friction", "", 0.0, 2.0, "mu of bur on bone: pays for dose, loads the spindle",
        valueIn<&ErosionSettings::friction>},
    Row{std::nullopt, "worn", "", 0.0, 1.0, "0 a new bur, 1 one that removes nothing", valueIn<&ErosionSettings::worn>},
};

constexpr auto kTable = withTissueFactors<kFactor, &ErosionSettings::tissue_factor>(
    kRows, 1000.0, "removal of this tissue relative to cortical bone");

}  // namespace

std::optional<ErosionKind> erosionOfKey(std::string_view key) { return kindOfKey(kErosions, key); }

std::span<const ErosionParameter> erosionParameters() { return kTable; }

ErosionSettings sanitised(const ErosionSettings& settings) { return sanitisedBy<kTable>(settings, kErosions.size()); }

}  // namespace haptics

#include "haptics/bone/erosion.h"

#include "haptics/bone/parameter_table.h"

namespace haptics {
namespace {

template <std::size_t Tissue>
constexpr ErosionParameter tissueFactor(std::string_view key) {
  return {std::nullopt,
          key,
          "",
          0.0,
          1000.0,
          "removal of this tissue relative to cortical bone",
          [](ErosionSettings& settings) -> double& { return settings.tissue_factor[Tissue]; }};
}

constexpr std::array kTable = {
    ErosionParameter{ErosionKind::time, "removal_rate_per_s", "1/s", 0.0, 1000.0,
                     "k: part of a covered voxel that goes in a second at the rated speed",
                     valueIn<&ErosionSettings::time, &TimeErosion::removal_rate_per_s>},
    ErosionParameter{ErosionKind::time, "rated_rpm", "rpm", 100.0, 400000.0, "w_rated: the speed k is stated for",
                     valueIn<&ErosionSettings::time, &TimeErosion::rated_rpm>},
    ErosionParameter{ErosionKind::dose, "removal_mm3_per_J", "mm3/J", 0.0, 100.0,
                     "alpha: reference tissue removed per work of friction",
                     valueIn<&ErosionSettings::dose, &DoseErosion::removal_mm3_per_J>},
    ErosionParameter{ErosionKind::machining, "cutting_energy_J_per_mm3", "J/mm3", 0.001, 10.0,
                     "u: work of cutting reference tissue",
                     valueIn<&ErosionSettings::machining, &MachiningErosion::cutting_energy_J_per_mm3>},
    ErosionParameter{std::nullopt, "friction", "", 0.0, 2.0, "mu of bur on bone: pays for dose, loads the spindle",
                     [](ErosionSettings& settings) -> double& { return settings.friction; }},
    ErosionParameter{std::nullopt, "worn", "", 0.0, 1.0, "0 a new bur, 1 one that takes nothing",
                     [](ErosionSettings& settings) -> double& { return settings.worn; }},
    tissueFactor<0>("factor_unlabelled"),
    tissueFactor<1>("factor_cortical"),
    tissueFactor<2>("factor_trabecular"),
    tissueFactor<3>("factor_other_teeth"),
    tissueFactor<4>("factor_enamel"),
    tissueFactor<5>("factor_dentine"),
    tissueFactor<6>("factor_pulp"),
    tissueFactor<7>("factor_mandibular_canal"),
    tissueFactor<8>("factor_ligament"),
    tissueFactor<9>("factor_gingiva"),
};
static_assert(assets::kTissueCount == 10, "a factor for every tissue");

}  // namespace

std::optional<ErosionKind> erosionOfKey(std::string_view key) {
  for (const ErosionName& law : kErosions)
    if (law.key == key) return law.kind;
  return std::nullopt;
}

std::span<const ErosionParameter> erosionParameters() { return kTable; }

ErosionSettings sanitised(const ErosionSettings& settings) {
  ErosionSettings safe = settings;
  if (static_cast<std::size_t>(safe.kind) >= kErosions.size()) safe.kind = ErosionSettings{}.kind;
  clampToTable<kTable>(safe);
  return safe;
}

}  // namespace haptics

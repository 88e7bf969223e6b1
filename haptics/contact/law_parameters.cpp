#include "haptics/contact/law_parameters.h"

#include <algorithm>
#include "haptics/bone/parameter_table.h"

namespace haptics {
namespace {

constexpr double kStiffest_N_per_mm = 20.0;

template <std::size_t Tissue>
constexpr LawParameter tissueFactor(std::string_view key) {
  return {std::nullopt,
          key,
          "",
          0.0,
          10.0,
          "stiffness of this tissue relative to cortical bone",
          "ordered as the moduli of reference/physics 4, compressed to what a device renders",
          [](LawSettings& settings) -> double& { return settings.tissue.factor[Tissue]; }};
}

constexpr std::array kTable = {
    LawParameter{LawKind::agus, "stiffness_N_per_mm", "N/mm", 0.0, kStiffest_N_per_mm, "k: force per depth",
                 "Agus et al., Presence 12(1) 2003; 0.8 feels hard at 1 kHz (Choi & Tan 2004)",
                 valueIn<&LawSettings::agus, &AgusParameters::stiffness_N_per_mm>},
    LawParameter{LawKind::forssim, "force_constant_N", "N", 0.0, 20.0, "P: force per shared volume over R^3",
                 "Forsslund et al. 2009; default 0.8 as published",
                 valueIn<&LawSettings::forssim, &ForssimParameters::force_constant_N>},
    LawParameter{LawKind::forssim, "hold_N_per_mm", "N/mm", 0.0, kStiffest_N_per_mm,
                 "spring that holds a deeply immersed bur; 0: none", "Forsslund et al. 2009; published 1 N/mm",
                 valueIn<&LawSettings::forssim, &ForssimParameters::hold_N_per_mm>},
    LawParameter{LawKind::forssim, "hold_from", "", 0.05, 0.95, "immersed fraction that starts the hold",
                 "Forsslund et al. 2009", valueIn<&LawSettings::forssim, &ForssimParameters::hold_from>},
    LawParameter{LawKind::forssim, "hold_until", "", 0.05, 0.95, "immersed fraction below which the hold may end",
                 "Forsslund et al. 2009", valueIn<&LawSettings::forssim, &ForssimParameters::hold_until>},
    LawParameter{LawKind::hertz, "hertz_N_per_mm2", "N/mm2", 0.0, 100.0, "C1: elastic constant, a gain",
                 "Agus et al. 2002; 1 N at 0.5 mm under a 2 mm ball (reference/physics 6)",
                 valueIn<&LawSettings::hertz, &HertzParameters::hertz_N_per_mm2>},
    LawParameter{LawKind::shell, "shell_N_per_mm3", "N/mm3", 0.0, 10.0, "k_s: pressure per immersed surface",
                 "Petersik et al. 2002; K / (2 pi R)", valueIn<&LawSettings::shell, &ShellParameters::shell_N_per_mm3>},
    LawParameter{LawKind::points, "stiffness_N_per_mm", "N/mm", 0.0, kStiffest_N_per_mm,
                 "k: force per depth in bone of density 1", "Gajananan; Morris et al. 2006",
                 valueIn<&LawSettings::points, &PointsParameters::stiffness_N_per_mm>},
    LawParameter{LawKind::machining, "chip_tangential_N_per_mm2", "N/mm2", 0.0, 1000.0, "K_tc: specific cutting energy",
                 "0.03-0.15 J/mm3 for cortical bone, reference/physics 4",
                 valueIn<&LawSettings::machining, &MachiningParameters::chip_tangential_N_per_mm2>},
    LawParameter{LawKind::machining, "chip_radial_N_per_mm2", "N/mm2", 0.0, 1000.0, "K_rc: thrust per chip area",
                 "K_rc / K_tc 0.3-1, reference/physics 1.5",
                 valueIn<&LawSettings::machining, &MachiningParameters::chip_radial_N_per_mm2>},
    LawParameter{LawKind::machining, "chip_axial_N_per_mm2", "N/mm2", 0.0, 1000.0,
                 "K_ac: pull along the flute per chip area; 0 without helix", "Arbabtafti et al., ToH 4(1) 2011",
                 valueIn<&LawSettings::machining, &MachiningParameters::chip_axial_N_per_mm2>},
    LawParameter{LawKind::machining, "edge_tangential_N_per_mm", "N/mm", 0.0, 20.0,
                 "K_te: drag of the edge, friction and ploughing", "calibrated to 2 N, reference/physics 6",
                 valueIn<&LawSettings::machining, &MachiningParameters::edge_tangential_N_per_mm>},
    LawParameter{LawKind::machining, "edge_radial_N_per_mm", "N/mm", 0.0, 20.0, "K_re: thrust of the edge",
                 "1.7-2.5 times the drag, reference/physics 4",
                 valueIn<&LawSettings::machining, &MachiningParameters::edge_radial_N_per_mm>},
    LawParameter{LawKind::machining, "edge_axial_N_per_mm", "N/mm", 0.0, 20.0, "K_ae: pull of the edge along the flute",
                 "Arbabtafti et al., ToH 4(1) 2011",
                 valueIn<&LawSettings::machining, &MachiningParameters::edge_axial_N_per_mm>},
    LawParameter{LawKind::machining, "flutes", "", 1.0, 64.0, "N: cutting edges around the head", "8: a round bone bur",
                 valueIn<&LawSettings::machining, &MachiningParameters::flutes>},
    LawParameter{LawKind::machining, "thickest_chip_mm", "mm", 0.0001, 0.1, "chip thickness at which the flute is full",
                 "Arbabtafti et al., ToH 4(1) 2011",
                 valueIn<&LawSettings::machining, &MachiningParameters::thickest_chip_mm>},
    LawParameter{LawKind::machining, "slowest_cut_rpm", "1/min", 1.0, 100000.0,
                 "spindle speed below which cutting fades into a wall", "slow handpieces turn from 1,000",
                 valueIn<&LawSettings::machining, &MachiningParameters::slowest_cut_rpm>},
    LawParameter{LawKind::machining, "worn", "", 0.0, 1.0,
                 "0 a new bur, 1 one whose edges drag and press three times as hard", "a gain",
                 valueIn<&LawSettings::machining, &MachiningParameters::worn>},
    LawParameter{LawKind::machining, "vibration_share", "", 0.0, 0.1, "vibration as a share of the force",
                 "at most a tenth, reference/devices 6",
                 valueIn<&LawSettings::machining, &MachiningParameters::vibration_share>},
    LawParameter{LawKind::harmonic, "stiffness_N_per_mm", "N/mm", 0.0, kStiffest_N_per_mm, "k: force per depth",
                 "reference/physics 2.8", valueIn<&LawSettings::harmonic, &HarmonicParameters::stiffness_N_per_mm>},
    LawParameter{std::nullopt, "damping_Ns_per_mm", "Ns/mm", 0.0, 0.1, "b: force against the hand's motion in contact",
                 "counts against the passive stiffness, K < 2 (b_device - b) / T (reference/physics 2.5)",
                 [](LawSettings& settings) -> double& { return settings.damping_Ns_per_mm; }},
    tissueFactor<0>("stiffness_unlabelled"),
    tissueFactor<1>("stiffness_cortical"),
    tissueFactor<2>("stiffness_trabecular"),
    tissueFactor<3>("stiffness_other_teeth"),
    tissueFactor<4>("stiffness_enamel"),
    tissueFactor<5>("stiffness_dentine"),
    tissueFactor<6>("stiffness_pulp"),
    tissueFactor<7>("stiffness_mandibular_canal"),
    tissueFactor<8>("stiffness_ligament"),
    tissueFactor<9>("stiffness_gingiva"),
};
static_assert(assets::kTissueCount == 10, "a factor for every tissue");

}  // namespace

std::span<const LawParameter> lawParameters() { return kTable; }

const LawParameter* findLawParameter(LawKind law, std::string_view key) {
  const auto found = std::find_if(kTable.begin(), kTable.end(), [&](const LawParameter& parameter) {
    return parameter.key == key && parameter.law.value_or(law) == law;
  });
  return found == kTable.end() ? nullptr : &*found;
}

std::optional<LawKind> lawOfKey(std::string_view key) {
  for (const LawName& law : kLaws)
    if (law.key == key) return law.kind;
  return std::nullopt;
}

LawSettings sanitised(const LawSettings& settings) {
  LawSettings safe = settings;
  if (static_cast<std::size_t>(safe.kind) >= kLaws.size()) safe.kind = LawSettings{}.kind;
  clampToTable<kTable>(safe);
  return safe;
}

}  // namespace haptics

#include "haptics/contact/law_parameters.h"

#include <algorithm>

namespace haptics {
namespace {

constexpr double kMaxStiffness_N_per_mm = 20.0;

constexpr std::string_view kStiffness = "stiffness_";

template <auto kMember>
constexpr double& (*kForssim)(LawSettings&) = valueIn<&LawSettings::forssim, kMember>;
template <auto kMember>
constexpr double& (*kMachining)(LawSettings&) = valueIn<&LawSettings::machining, kMember>;
using Forssim = ForssimParameters;
using Cut = MachiningParameters;

using Row = LawParameter;
constexpr std::array kRows = {
    Row{LawKind::agus, "stiffness_N_per_mm", "N/mm", 0.0, kMaxStiffness_N_per_mm, "k: force per depth",
        valueIn<&LawSettings::agus, &AgusParameters::stiffness_N_per_mm>,
        "Agus et al., Presence 12(1) 2003; 0.8 feels hard at 1 kHz (Choi & Tan 2004)"},
    Row{LawKind::forssim, "force_constant_N", "N", 0.0, 20.0, "P: force per shared volume over R^3",
        kForssim<&Forssim::force_constant_N>, "Forsslund et al. 2009; default 0.8 as published"},
    Row{LawKind::forssim, "hold_N_per_mm", "N/mm", 0.0, kMaxStiffness_N_per_mm,
        "spring that holds a deeply immersed bur; 0: none", kForssim<&Forssim::hold_N_per_mm>,
        "Forsslund et al. 2009; published 1 N/mm"},
    Row{LawKind::forssim, "hold_from", "", 0.05, 0.95, "immersed fraction that starts the hold",
        kForssim<&Forssim::hold_from>, "Forsslund et al. 2009"},
    Row{LawKind::forssim, "hold_until", "", 0.05, 0.95, "immersed fraction below which the hold may end",
        kForssim<&Forssim::hold_until>, "Forsslund et al. 2009"},
    Row{LawKind::hertz, "hertz_N_per_mm2", "N/mm2", 0.0, 100.0, "C1: elastic constant, a gain",
        valueIn<&LawSettings::hertz, &HertzParameters::hertz_N_per_mm2>,
        "Agus et al. 2002; 1 N at 0.5 mm under a 2 mm ball (reference/physics 6)"},
    Row{LawKind::shell, "shell_N_per_mm3", "N/mm3", 0.0, 10.0, "k_s: pressure per immersed surface",
        valueIn<&LawSettings::shell, &ShellParameters::shell_N_per_mm3>, "Petersik et al. 2002; K / (2 pi R)"},
    Row{LawKind::points, "stiffness_N_per_mm", "N/mm", 0.0, kMaxStiffness_N_per_mm,
        "k: force per depth in bone of density 1", valueIn<&LawSettings::points, &PointsParameters::stiffness_N_per_mm>,
        "Gajananan; Morris et al. 2006"},
    Row{LawKind::machining, "chip_tangential_N_per_mm2", "N/mm2", 0.0, 1000.0, "K_tc: specific cutting energy",
        kMachining<&Cut::chip_tangential_N_per_mm2>, "0.03-0.15 J/mm3 for cortical bone, reference/physics 4"},
    Row{LawKind::machining, "chip_radial_N_per_mm2", "N/mm2", 0.0, 1000.0, "K_rc: thrust per chip area",
        kMachining<&Cut::chip_radial_N_per_mm2>, "K_rc / K_tc 0.3-1, reference/physics 1.5"},
    Row{LawKind::machining, "chip_axial_N_per_mm2", "N/mm2", 0.0, 1000.0,
        "K_ac: pull along the flute per chip area; 0 without helix", kMachining<&Cut::chip_axial_N_per_mm2>,
        "Arbabtafti et al., ToH 4(1) 2011"},
    Row{LawKind::machining, "edge_tangential_N_per_mm", "N/mm", 0.0, 20.0,
        "K_te: drag of the edge, friction and ploughing", kMachining<&Cut::edge_tangential_N_per_mm>,
        "calibrated to 2 N, reference/physics 6"},
    Row{LawKind::machining, "edge_radial_N_per_mm", "N/mm", 0.0, 20.0, "K_re: thrust of the edge",
        kMachining<&Cut::edge_radial_N_per_mm>, "1.7-2.5 times the drag, reference/physics 4"},
    Row{LawKind::machining, "edge_axial_N_per_mm", "N/mm", 0.0, 20.0, "K_ae: pull of the edge along the flute",
        kMachining<&Cut::edge_axial_N_per_mm>, "Arbabtafti et al., ToH 4(1) 2011"},
    Row{LawKind::machining, "flutes", "", 1.0, 64.0, "N: cutting edges around the head", kMachining<&Cut::flutes>,
        "8: a round bone bur"},
    Row{LawKind::machining, "thickest_chip_mm", "mm", 0.0001, 0.1, "chip thickness at which the flute is full",
        kMachining<&Cut::thickest_chip_mm>, "Arbabtafti et al., ToH 4(1) 2011"},
    Row{LawKind::machining, "slowest_cut_rpm", "1/min", 1.0, 100000.0,
        "spindle speed below which cutting fades into a wall", kMachining<&Cut::slowest_cut_rpm>,
        "slow handpieces turn from 1,000"},
    Row{LawKind::machining, "worn", "", 0.0, 1.0, "0 a new bur, 1 one whose edges drag and press three times as hard",
        kMachining<&Cut::worn>, "a gain"},
    Row{LawKind::machining, "vibration_share", "", 0.0, 0.1, "vibration as a share of the force",
        kMachining<&Cut::vibration_share>, "at most a tenth, reference/devices 6"},
    Row{LawKind::harmonic, "stiffness_N_per_mm", "N/mm", 0.0, kMaxStiffness_N_per_mm, "k: force per depth",
        valueIn<&LawSettings::harmonic, &HarmonicParameters::stiffness_N_per_mm>, "reference/physics 2.8"},
    Row{std::nullopt, "damping_Ns_per_mm", "Ns/mm", 0.0, 0.1, "b: force against the hand's motion in contact",
        valueIn<&LawSettings::damping_Ns_per_mm>,
        "counts against the passive stiffness, K < 2 (b_device - b) / T (reference/physics 2.5)"},
};

constexpr auto kTable = withTissueFactors<kStiffness, &LawSettings::tissue, &TissueStiffness::factor>(
    kRows, 10.0, "stiffness of this tissue relative to cortical bone",
    "ordered as the moduli of reference/physics 4, compressed to what a device renders");

}  // namespace

std::span<const LawParameter> lawParameters() { return kTable; }

const LawParameter* findLawParameter(LawKind law, std::string_view key) {
  const auto found = std::find_if(kTable.begin(), kTable.end(), [&](const LawParameter& parameter) {
    return parameter.key == key && parameter.law.value_or(law) == law;
  });
  return found == kTable.end() ? nullptr : &*found;
}

std::optional<LawKind> lawOfKey(std::string_view key) { return kindOfKey(kLaws, key); }

LawSettings sanitised(const LawSettings& settings) { return sanitisedBy<kTable>(settings, kLaws.size()); }

}  // namespace haptics

// The table of tissues: label values of every volume, names, grey values and factors. Help, panels, files and import
// messages are made from it. Labels 1..9 are those of the segmentations that are imported, files keep the values of
// all; unknown values count as `unlabelled`. Plain data; any thread. HU of adult CT: enamel 2071-2955, dentine
// 1323-1899 (Reshetnikov 2024), cortical above 1250 (Misch D1). Removal from hardness
// (enamel:dentine:cortical:cancellous:pulp = 1:3:3:10:50, reference/physics 6). Stiffness ordered as the moduli of
// reference/physics 4 (GPa: enamel 70-105, dentine 15-25, cortical 10-20, cancellous 0.1-2), compressed to the range a
// device can render. Carious dentine: zones of falling hardness (Pugach 2009), stiffness 0.25 and 0.6, removal 12 and 3
// times dentine's (ratios of our own). Fillings: cured as dentine x 0.8, uncured removal 100, the rest our defaults.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace assets {

enum class Tissue : std::uint8_t {
  unlabelled = 0,  ///< air, or a scan without segmentation
  cortical = 1,
  trabecular = 2,
  other_teeth = 3,  ///< hard tissue of a tooth whose enamel and dentine are not distinguished
  enamel = 4,       ///< of any tooth; CtVolume::tooth has its number
  dentine = 5,
  pulp = 6,
  mandibular_canal = 7,  ///< with nerve and vessels
  ligament = 8,          ///< periodontal ligament or follicle
  gingiva = 9,
  caries_soft = 10,  ///< infected: to be removed
  caries_firm = 11,  ///< affected: may stay over the pulp
  // Laid by a dentist (haptics/bone/filling); no scan and no patient has these.
  composite_soft = 12,  ///< not cured yet
  composite = 13,
  glass_ionomer_soft = 14,
  glass_ionomer = 15,
  amalgam = 16,
  wax = 17,
  gutta_percha = 18,
  amalgam_soft = 19,  ///< not set yet
};
inline constexpr int kTissueCount = 20;
inline constexpr int kScanTissueCount = 12;  ///< labels that a volume may have

struct TissueProperties {
  std::string_view key;     ///< in files and on the command line
  std::string_view name;    ///< for people
  double hounsfield;        ///< mean grey value in the synthetic patient
  double removal_factor;    ///< fraction removed per second, relative to cortical bone
  double stiffness_factor;  ///< gain of the felt stiffness, relative to cortical bone
  bool hard;                ///< bone, enamel, dentine
  bool tooth;
};

inline constexpr std::array<TissueProperties, kTissueCount> kTissues = {{
    {"unlabelled", "unlabelled", -1000.0, 1.0, 1.0, false, false},
    {"cortical", "cortical bone", 1350.0, 1.0, 1.0, true, false},
    {"trabecular", "trabecular bone", 420.0, 10.0 / 3.0, 0.4, true, false},
    {"other_teeth", "other teeth", 1700.0, 1.0, 1.2, true, true},
    {"enamel", "enamel", 2500.0, 1.0 / 3.0, 1.5, true, true},
    {"dentine", "dentine", 1650.0, 1.0, 1.1, true, true},
    {"pulp", "pulp", 150.0, 50.0 / 3.0, 0.1, false, true},
    {"mandibular_canal", "mandibular canal", 40.0, 50.0 / 3.0, 0.1, false, false},
    {"ligament", "ligament", 60.0, 50.0 / 3.0, 0.1, false, false},
    {"gingiva", "gingiva", 60.0, 50.0 / 3.0, 0.1, false, false},
    {"caries_soft", "soft caries", 700.0, 12.0, 0.275, true, true},
    {"caries_firm", "firm caries", 1250.0, 3.0, 0.66, true, true},
    {"composite_soft", "uncured composite", 1900.0, 100.0, 0.12, false, false},
    {"composite", "composite", 1900.0, 1.25, 0.88, false, false},
    {"glass_ionomer_soft", "uncured glass ionomer", 1700.0, 100.0, 0.12, false, false},
    {"glass_ionomer", "glass ionomer", 1700.0, 1.25, 0.88, false, false},
    {"amalgam", "amalgam", 3000.0, 1.0, 1.2, false, false},
    {"wax", "wax", 100.0, 60.0, 0.2, false, false},
    {"gutta_percha", "gutta-percha", 2500.0, 60.0, 0.2, false, false},
    {"amalgam_soft", "plastic amalgam", 3000.0, 30.0, 0.4, false, false},
}};

constexpr const TissueProperties& properties(std::uint8_t label) { return kTissues[label < kTissueCount ? label : 0]; }

constexpr bool isHard(std::uint8_t label) { return properties(label).hard; }
constexpr bool isTooth(std::uint8_t label) { return properties(label).tooth; }
constexpr bool isCaries(std::uint8_t label) {
  return Tissue{label} == Tissue::caries_soft || Tissue{label} == Tissue::caries_firm;
}
/// Enamel, dentine, pulp or caries.
constexpr bool isToothPart(std::uint8_t label) { return isTooth(label) && Tissue{label} != Tissue::other_teeth; }

}  // namespace assets

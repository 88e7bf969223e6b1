// The tissues a voxel can hold: the label values of every volume, and what CT shows of each.
// Labels 1..9 are those of the segmentations we import; unknown values count as `unlabelled`.
// Plain data; any thread. HU: reference/physics values (adult CT: enamel 2071-2955, dentine 1323-1899 HU, Reshetnikov
// 2024; cortical > 1250 HU, Misch D1). Not colours (render) and not the live bone (haptics).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace assets {

enum class Tissue : std::uint8_t {
  unlabelled = 0,  ///< air, or a scan without segmentation
  cortical = 1,
  trabecular = 2,
  other_teeth = 3,  ///< a tooth whose enamel and dentine are not told apart
  enamel = 4,       ///< of any tooth: which one says CtVolume::tooth
  dentine = 5,
  pulp = 6,
  mandibular_canal = 7,  ///< mandibular canal with nerve and vessels
  ligament = 8,          ///< periodontal ligament or follicle
  gingiva = 9,
};
inline constexpr int kTissueCount = 10;

/// Bone, enamel, dentine: what is solid in a scan.
constexpr bool isHard(std::uint8_t label) {
  const Tissue tissue{label};
  return tissue == Tissue::cortical || tissue == Tissue::trabecular || tissue == Tissue::other_teeth ||
         tissue == Tissue::enamel || tissue == Tissue::dentine;
}

struct TissueProperties {
  std::string_view key;     ///< in files and on the command line
  std::string_view name;    ///< for people
  double hounsfield;        ///< mean grey value of the synthetic patient
  double removal_factor;    ///< fraction removed per second relative to cortical bone (enamel:dentine:cortical:
                            ///< cancellous:pulp = 1:3:3:10:50, reference/physics 6, from hardness)
  double stiffness_factor;  ///< felt stiffness relative to cortical bone; ordered as the moduli of reference/physics 4
                            ///< (enamel 70-105, dentine 15-25, cortical 10-20, cancellous 0.1-2 GPa), compressed to
                            ///< what a device can render: a gain, not a modulus
};

inline constexpr std::array<TissueProperties, kTissueCount> kTissues = {{
    {"unlabelled", "unlabelled", -1000.0, 1.0, 1.0},
    {"cortical", "cortical bone", 1350.0, 1.0, 1.0},
    {"trabecular", "trabecular bone", 420.0, 10.0 / 3.0, 0.4},
    {"other_teeth", "other teeth", 1700.0, 1.0, 1.2},
    {"enamel", "enamel", 2500.0, 1.0 / 3.0, 1.5},
    {"dentine", "dentine", 1650.0, 1.0, 1.1},
    {"pulp", "pulp", 150.0, 50.0 / 3.0, 0.1},
    {"mandibular_canal", "mandibular canal", 40.0, 50.0 / 3.0, 0.1},
    {"ligament", "ligament", 60.0, 50.0 / 3.0, 0.1},
    {"gingiva", "gingiva", 60.0, 50.0 / 3.0, 0.1},
}};

constexpr const TissueProperties& properties(std::uint8_t label) { return kTissues[label < kTissueCount ? label : 0]; }

}  // namespace assets

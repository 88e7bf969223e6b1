// What the numbers of a foreign label map mean. Tables are chosen by the names that a file gives to its labels, or by
// the owner's word, never by numbers alone: 33 is tooth 37 in one ToothFairy numbering and 33 in the other. Sources:
// DentalSegmentator (github gaudot/SlicerDentalSegmentator), ToothFairy2 and its 42-class nets, TotalSegmentator's
// tasks teeth and craniofacial_structures, AMASSS (DCBIA-OrthoLab). Pure; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "assets/tissue.h"

namespace assets {

enum class LabelKind : std::uint8_t {
  nothing,   ///< upper jaw, skull, soft tissue, implants
  mandible,  ///< bone, solid or its cortex alone
  canal,
  teeth,   ///< lower teeth, not told apart
  tooth,   ///< one, by its number
  pulp,    ///< its number may be 0: that of the tooth round it
  tissue,  ///< a value of Molar's own
};

struct LabelMeaning {
  LabelKind kind = LabelKind::nothing;
  int fdi = 0;
  Tissue tissue = Tissue::unlabelled;

  bool operator==(const LabelMeaning&) const = default;
};

using LabelTable = std::array<LabelMeaning, 256>;

enum class LabelSet {
  molar,
  dental_segmentator,
  toothfairy,  ///< one of the next two, as the values show
  toothfairy_fdi,
  toothfairy_contiguous,
  total_segmentator,
  craniofacial,
  amasss
};
inline constexpr std::array<std::string_view, 8> kLabelSets = {"molar",
                                                               "dentalsegmentator",
                                                               "toothfairy",
                                                               "toothfairy-fdi",
                                                               "toothfairy-contiguous",
                                                               "totalsegmentator",
                                                               "craniofacial",
                                                               "amasss"};

/// `is_present`: which values the file holds. None: both numberings of ToothFairy fit.
std::optional<LabelTable> labelTable(LabelSet set, const std::array<bool, 256>& is_present);

/// By the names of the labels; names that mean nothing here are passed over.
LabelTable labelTable(const std::map<int, std::string>& names);

/// "lower_left_second_molar_fdi37", "Mandible", "Left Inferior Alveolar Canal" …
LabelMeaning meaningOf(std::string_view name);

}  // namespace assets

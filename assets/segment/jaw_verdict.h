// Whether what was found can be the lower jaw of a person with teeth. Far from it, no tooth must be named, least of all
// a third molar. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/segment/jaw_signs.h"
#include "assets/segment/tooth_numbers.h"

namespace assets {

/// Why there is no segmentation: a code for programs, a sentence for people without its subject.
struct JawRefusal {
  std::string code, sentence;
};

JawRefusal toothlessJaw();
JawRefusal upperArch();

/// `teeth`: of at least 80 mm3. None: it may be a lower jaw.
std::optional<JawRefusal> judgeJaw(const VolumeGrid& jaw_box, const std::vector<FoundTooth>& teeth);
/// Half of the signs of teeth are enough: crowns are worn, metal, or lost.
std::optional<JawRefusal> judgeSigns(const JawSigns& signs, double hard_within_arch);
/// Once parts of one tooth are joined.
std::optional<JawRefusal> judgeCount(const std::vector<FoundTooth>& teeth);

}  // namespace assets

// Which parts of a divided body belong together, decided on the graph of parts and necks alone. Joined first are those
// with the highest score: neck / thinner peak, + 0.25 where one side has less than 4 % enamel (a root), + 0.25 where
// one is below 90 mm3; as long as one exceeds 0.88. Pure; a few hundred parts in milliseconds.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace assets {

struct RegionPart {
  double peak = 0.0;  ///< of its thickness; in the unit of the necks
  double volume_mm3 = 0.0, enamel_mm3 = 0.0;
};

/// Numbers of parts, the smaller first; thickness of the neck.
using RegionNecks = std::map<std::pair<std::int32_t, std::int32_t>, float>;

/// By part: the part it has joined, itself otherwise. [0] is no part.
std::vector<std::int32_t> joinedParts(std::vector<RegionPart> parts, RegionNecks necks);

}  // namespace assets

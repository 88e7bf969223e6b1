// What a dentist calls the pieces of a sectioned tooth: the tooth, its crown, a root, a half of it; where two would
// have the same name, by their side. Frame P. Pure; any thread.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/case/impaction_measures.h"

namespace app {

struct SeenPiece {
  std::optional<double> enamel_share;  ///< of the tooth's enamel at first; none: it has none, or it is not labelled
  glm::dvec3 middle_P_mm{0.0};
};

/// By piece. `tooth_P_mm`: middle of the tooth at first. `is_whole`: nothing has come off it.
std::vector<std::string> pieceNames(std::span<const SeenPiece> pieces, const glm::dvec3& tooth_P_mm, bool is_whole,
                                    const std::optional<ArchFrame>& arch);

/// How to lift a piece that moves by `by_P_mm`: "up and back", "up and to the cheek".
std::string liftInWords(const glm::dvec3& by_P_mm, double turned_rad, const ArchFrame& arch);

}  // namespace app

// What measures are told of the case beside the bone that a session holds: structures to keep off, directions at the
// site, and what was to be removed. Made by app/station/session_case from the start of a session. Frame P, mm; plain
// values; any thread.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include <glm/glm.hpp>

#include "app/session/session_start.h"
#include "assets/planned_cut.h"
#include "assets/risk_structures.h"

namespace app {

/// Unit, at the operated tooth, or of a practice block.
struct CaseDirections {
  glm::dvec3 distal_P{0.0, 1.0, 0.0}, buccal_P{-1.0, 0.0, 0.0}, up_P{0.0, 0.0, 1.0};
};

struct SessionCase {
  assets::RiskStructures risks;
  std::optional<CaseDirections> directions;  ///< none: no operated tooth is known
  std::optional<assets::PlannedCut> plan;    ///< none: why_no_plan
  std::string_view why_no_plan = "the case was not looked at";
  /// Signed distance to what is to be removed, negative inside; empty: no plan.
  std::function<double(const glm::dvec3&)> from_plan_mm;
  glm::dvec3 sight_P{0.0};  ///< to the eye that sees the site, where eyes were not recorded; 0: not known
};

using CaseOf = std::function<SessionCase(const StoredStart&)>;

}  // namespace app

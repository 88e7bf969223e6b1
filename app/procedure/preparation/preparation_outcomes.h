// What a tooth preparation has come to against its ideal: P1 to P9 (reference/sisters 5.3), raw millimetres first, no
// single mark. From the tooth before and after. Frame P, mm. Any thread but the servo's; the ideal of a molar at 0.05
// mm some 1.5 s once, the outcomes some 0.25 s.
#pragma once

#include <optional>
#include <string>

#include "app/procedure/preparation/caries_outcome.h"
#include "app/procedure/preparation/cavity_form.h"
#include "app/procedure/preparation/deviation.h"
#include "app/procedure/preparation/filling_outcomes.h"
#include "app/procedure/preparation/given_ideal.h"
#include "app/procedure/preparation/margin_line.h"
#include "app/procedure/preparation/removed_material.h"
#include "app/procedure/preparation/undercut.h"

namespace app {

struct PreparationOutcomes {
  RemovedMaterial removed;                      ///< P1, P7
  Deviation deviation;                          ///< P2, P8
  std::optional<WallForm> walls;                ///< P3, P6: crowns
  std::optional<MarginLine> margin;             ///< P4: crowns
  std::optional<InsertionWay> axis, insertion;  ///< P5: crowns, along the tooth's axis and along the best way
  std::optional<BoxBytes> stump;                ///< crowns: without splinters that stand by themselves
  double deepest_undercut_mm = 0.0;             ///< P5: square to the wall; below 0.02 mm it is the voxels' roughness
  std::optional<CavityForm> cavity;             ///< P9: cavities
  std::optional<FillingOutcomes> filling;       ///< where something was laid
  std::optional<CariesOutcome> caries;          ///< of a tooth that has some
};

/// The tooth and its ideal, measured as often as wanted.
class PreparationMeasure {
 public:
  /// Throws UsageError, beginning with `option`, where the tooth is too small for its ideal.
  PreparationMeasure(Crown crown, const IdealRule& rule, const std::string& option);
  /// By rule, or as it was given. Throws UsageError, beginning with `option`, also where that is of another tooth.
  PreparationMeasure(Crown crown, const assets::PreparedTooth& tooth, const std::string& option);
  PreparationMeasure(const PreparationMeasure&) = delete;
  PreparationMeasure& operator=(const PreparationMeasure&) = delete;

  /// `made`: of the same fine grid.
  PreparationOutcomes outcomesOf(const FineSolid& made) const {
    return outcomesOf(BoxBytes(made, crown_.solid.grid()));
  }
  PreparationOutcomes outcomesOf(const BoxBytes& made) const;

  /// The first call takes some 0.3 s more.
  FillingOutcomes fillingOf(const BoxBytes& made, const LaidBoxes& filling);

  const Crown& crown() const { return crown_; }
  const BoxBytes& ideal() const { return ideal_; }
  const IdealRule& rule() const { return by_rule_ ? by_rule_->rule() : given_->rule(); }

 private:
  PreparedZone zone(const glm::dvec3& p_mm) const { return by_rule_ ? by_rule_->zone(p_mm) : given_->zone(p_mm); }
  void takeGiven(const assets::GivenIdeal& given, const std::string& option);
  void measureBefore();

  Crown crown_;
  std::optional<PreparedIdeal> by_rule_;  ///< one of both
  std::optional<GivenForm> given_;
  BoxBytes ideal_;
  std::optional<StumpWalls> walls_before_;  ///< crowns
  std::optional<CariesMeasure> caries_;
  std::optional<IdealDistance> distance_;
  std::optional<FillingMeasure> filling_;
};

}  // namespace app

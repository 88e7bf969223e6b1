// Incision, flap and retraction in a rehearsal that begins with the gum closed. The blade's incision is recorded; when
// the periosteal elevator first works at it a sheet is laid between incision and base, which peels, is lifted, and is
// held by the assistant's retractor. On a grid of 100 Hz of simulated time, from the recorded ticks and commands alone:
// the same recording gives the same flap, bit for bit. Frame P; mm, N, s. Main thread; 0.3 ms per 10 ms while raised.
// Not modelled: bleeding, sutures, the gum on the tongue's side, which gives way without being raised.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "app/procedure/flap/flap_plan.h"
#include "app/procedure/flap/flap_sheet.h"
#include "app/procedure/flap/gum_chart.h"
#include "app/procedure/flap/incision.h"
#include "app/session/flap_event.h"
#include "assets/soft_tissue_field.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

class Flap {
 public:
  /// So much of what the plan bares lies bare: the bur may come.
  static constexpr double kRaisedShare = 0.9;

  /// `gum_P`: closed. Borrows the soft tissue, which is lip and cheek for a sheet that is turned over. `down_P`: as the
  /// patient lies.
  Flap(const assets::Patient& patient, const assets::MeshModel& gum_P, const assets::PlannedCut& cut,
       const assets::SoftTissueField& soft_tissue, const glm::dvec3& down_P);
  Flap(const Flap&) = delete;
  Flap& operator=(const Flap&) = delete;

  /// Every tick in order, made with this command.
  void follow(const haptics::Tick& tick, const haptics::Command& command);

  const GumChart& chart() const { return chart_; }
  const FlapPlan& plan() const { return plan_; }
  const Incision& incision() const { return incision_; }
  /// None: nothing is raised yet.
  const std::optional<FlapSheet>& sheet() const { return sheet_; }
  /// Rises with every change of what is drawn: of the incision, of which gum the sheet replaces, of the sheet.
  std::uint64_t incisionRevision() const { return incision_revision_; }
  std::uint64_t sheetNumber() const { return sheet_number_; }
  std::uint64_t sheetRevision() const { return sheet_revision_; }

  /// Raised over the plan and held aside: bone can be reached.
  bool isAside() const;
  FlapRecord record() const;
  /// What went wrong, or is well, in a line; once each.
  std::optional<std::string> news();

 private:
  void step(const haptics::Tick& tick, const haptics::Command& command);
  void raise(const haptics::Tick& tick);
  void laySheet();
  void retract(const haptics::Command& command);
  void touch(const haptics::Tick& tick, const haptics::Tool& tool);
  glm::dvec3 besideCheek(const glm::dvec3& p_P_mm) const;
  FlapSheet::Ground cheekAt(const glm::dvec3& p_P_mm) const;
  double raisedShare() const;
  double freeShare() const;

  const assets::SoftTissueField& soft_;
  GumChart chart_;
  FlapPlan plan_;
  glm::dvec3 down_P_;
  Incision incision_;
  std::optional<FlapSheet> sheet_;
  std::vector<std::optional<std::size_t>> over_bared_;  ///< the sheet's vertex over each place of the plan
  std::size_t points_in_sheet_ = 0;                     ///< of the incision, when it was laid

  // Since the last frame of the grid.
  std::int64_t frame_ = -1;
  bool met_bone_ = false;
  std::optional<glm::dvec3> elevator_before_P_mm_;

  bool asked_before_ = false;          ///< for the retractor
  bool gave_up_ = false;               ///< it has slipped, until it is asked for again
  double pulled_ = 0.0;                ///< 0..1 of its way
  double tear_s_ = 0.0, bur_s_ = 0.0;  ///< until which the same is not counted again
  bool told_raised_ = false;
  int tears_ = 0, slips_ = 0, bur_touches_ = 0;
  std::deque<std::string> news_;
  std::uint64_t incision_revision_ = 0, sheet_number_ = 0, sheet_revision_ = 0;
};

/// Laid between the incision and the base, whole; none where nothing is cut through.
std::optional<FlapSheet> sheetFor(const GumChart& chart, const FlapPlan& plan, const Incision& incision);

}  // namespace app

#include "app/procedure/root_canal/treatment_meter.h"

#include <algorithm>
#include <utility>

namespace app {

TreatmentMeter::TreatmentMeter(const assets::ToothCanals& tooth, const ToothBlocks& before)
    : tooth_(tooth), before_(before), now_(before), laid_(before.grid()) {
  canals_.reserve(tooth.canals.size());
  for (std::size_t n = 0; n < tooth.canals.size(); ++n)
    canals_.push_back({CanalSections(before_, now_, tooth.canals[n], furcationSide_P(tooth, n)), {}});
}

void TreatmentMeter::change(glm::ivec3 block, const ToothNow::Bytes& bytes) {
  const auto place = now_.set(block, bytes);
  if (!place) return;
  if (*place == cuts_.size()) {
    cuts_.emplace_back();
    news_.push_back(*place);
  } else if (!std::exchange(cuts_[*place].is_new, true)) {
    news_.push_back(*place);
  }
}

/// What a change of blocks leaves unknown, and what was cut of them.
void TreatmentMeter::follow() {
  std::vector<glm::ivec3> blocks;
  for (const std::size_t place : std::exchange(news_, {})) {
    const glm::ivec3 block = now_.told()[place];
    blocks.push_back(block);
    Cut& cut = cuts_[place];
    cut.is_new = false;
    cut.of_canal_mm3.assign(canals_.size(), 0.0);
    removedOfCanals(before_, now_, tooth_.canals, std::span(&block, 1), cut.of_canal_mm3);
    cut.lost = lostTissue(before_, now_, tooth_, std::span(&block, 1));
    cut.may_be_hole = mayBePerforated(before_, now_, tooth_.frame, block);
  }
  if (blocks.empty()) return;
  const assets::VolumeGrid& grid = before_.grid();
  perforations_.reset();
  if (std::ranges::any_of(blocks, [&](const glm::ivec3& b) { return isOverChamber(tooth_, grid, b); })) {
    roof_.reset();
    outline_.reset();
  }
  for (Canal& canal : canals_) {
    if (canal.sections.forget(blocks)) canal.is_known = false;
    const assets::ToothCanal& of = canal.sections.canal();
    if (std::ranges::any_of(blocks, [&](const glm::ivec3& b) { return isOverOrifice(of, grid, b); }))
      canal.is_line_known = false;
  }
}

void TreatmentMeter::measureCanals(const FileUse& files) {
  for (std::size_t n = 0; n < canals_.size(); ++n) {
    Canal& canal = canals_[n];
    double removed_mm3 = 0.0;
    for (const Cut& cut : cuts_) removed_mm3 += cut.of_canal_mm3[n];
    TreatedCanal& treated = canal.treated;
    treated.name = tooth_.canals[n].name;
    const bool was_known = std::exchange(canal.is_known, true);
    if (!was_known) treated.outcomes = canalOutcomes(canal.sections, removed_mm3);
    treated.outcomes.removed_mm3 = removed_mm3;
    if (!laid_.isEmpty() && (is_laid_new_ || !was_known)) {
      treated.filling = rootFilling(canal.sections, now_, laid_, tooth_, n);
      for (CanalSection& section : treated.outcomes.sections) lookAtLaid(section, laid_);
    }
    if (!std::exchange(canal.is_line_known, true)) treated.straight_line = straightLine(now_, tooth_.canals[n]);
    treated.size = files.size(n);
    treated.length = files.tip(n).isEmpty() ? std::nullopt : std::optional(files.tip(n).error());
  }
  is_laid_new_ = false;
}

Treatment TreatmentMeter::measure(const FileUse& files) {
  follow();
  measureCanals(files);
  if (!roof_) roof_ = roofOutcome(now_, tooth_);
  if (!outline_) outline_ = outlineOutcome(before_, now_, tooth_);
  if (!perforations_) {
    const bool may_be = std::ranges::any_of(cuts_, [](const Cut& cut) { return cut.may_be_hole; });
    perforations_ = may_be ? perforations(before_, now_, tooth_) : std::vector<Perforation>();
  }
  Treatment all;
  for (const Canal& canal : canals_) all.canals.push_back(canal.treated);
  for (const Cut& cut : cuts_) all.lost += cut.lost;
  all.roof = *roof_;
  all.outline = *outline_;
  all.perforations = *perforations_;
  all.setFiles(files);
  return all;
}

}  // namespace app

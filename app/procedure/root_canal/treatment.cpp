#include "app/procedure/root_canal/treatment.h"

#include <algorithm>

#include "app/procedure/root_canal/canal_tip.h"

namespace app {

FileUse::FileUse(const assets::ToothCanals& tooth) : tooth_(tooth) {
  for (const assets::ToothCanal& canal : tooth_.canals) canals_.push_back({TipTrack(canal.length_mm())});
}

void FileUse::add(const haptics::Tick& tick, int size) {
  using haptics::FileStay;
  const haptics::FileWork& file = tick.file;
  if (file.stay == FileStay::none || file.stay == FileStay::through) return;
  torque_share_ = std::max(torque_share_, file.torque_share);
  filed_mm3_ = file.removed_total_mm3;
  if (file.stay == FileStay::wall) filing_s_ += tick.dt_s;
  if (file.broken_from_tip_mm > 0.0) ++broken_;
  if (size != in_hand_) is_bent_ = false;
  in_hand_ = size;
  if (file.keeps_bend && !is_bent_) ++bent_;
  is_bent_ = is_bent_ || file.keeps_bend;
  const auto place = canalTip(tooth_, file.tip_P_mm);
  if (!place) return;
  Canal& canal = canals_[place->canal];
  canal.tip.add(tick.t_s, place->along_mm);
  constexpr double kAtLength_mm = 1.0;
  if (canal.tip.error().at_rest_mm > -kAtLength_mm) canal.size = std::max(canal.size, size);
}

bool Treatment::isForamenMoved() const {
  return std::ranges::any_of(canals,
                             [](const TreatedCanal& one) { return one.outcomes.foramen_moved_mm > kForamenMoved_mm; });
}

Treatment treatmentOf(const assets::ToothCanals& tooth, const ToothBlocks& before, const FineSolid& after,
                      const FileUse& files) {
  Treatment all;
  for (std::size_t n = 0; n < tooth.canals.size(); ++n) {
    const assets::ToothCanal& canal = tooth.canals[n];
    all.canals.push_back({canal.name,
                          canalOutcomes(before, after, tooth.canals, n, furcationSide_P(tooth, n)),
                          {},
                          straightLine(after, canal),
                          files.size(n)});
    if (!files.tip(n).isEmpty()) all.canals.back().length = files.tip(n).error();
  }
  all.lost = lostTissue(before, after, tooth);
  all.roof = roofOutcome(after, tooth);
  all.outline = outlineOutcome(before, after, tooth);
  all.perforations = perforations(before, after, tooth);
  all.broken_files = files.broken(), all.bent_files = files.bent();
  all.torque_share = files.torque_share(), all.filed_mm3 = files.filed_mm3(), all.filing_s = files.filing_s();
  return all;
}

}  // namespace app

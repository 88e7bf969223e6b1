#include "app/procedure/root_canal/treatment.h"

#include <algorithm>

#include "app/procedure/root_canal/canal_tip.h"

namespace app {

void FileUse::add(const haptics::Tick& tick, int size) {
  const haptics::FileWork& file = tick.file;
  if (file.stay == haptics::FileStay::none) return;
  torque_share_ = std::max(torque_share_, file.torque_share);
  filed_mm3_ = file.removed_total_mm3;
  if (file.broken_from_tip_mm > 0.0) ++broken_;
  if (file.keeps_bend && !was_bent_) ++bent_;
  was_bent_ = file.keeps_bend;
  if (file.stay != haptics::FileStay::wall) return;
  filing_s_ += tick.dt_s;
  const auto place = canalTip(*tooth_, file.tip_P_mm);
  if (!place) return;
  Tips& tips = tips_[place->canal];
  tips.samples.push_back({tick.t_s, place->along_mm});
  constexpr double kShort_mm = 0.5, kAtLength_mm = 1.0;
  if (place->along_mm > tooth_->canals[place->canal].length_mm() - kShort_mm - kAtLength_mm)
    tips.size = std::max(tips.size, size);
}

std::optional<double> FileUse::deepest_mm(std::size_t canal) const {
  const std::vector<TipSample>& samples = tips_[canal].samples;
  if (samples.empty()) return {};
  return std::ranges::max(samples, {}, &TipSample::along_mm).along_mm;
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
                          lengthError(files.tips(n), canal.length_mm()),
                          straightLine(after, canal),
                          files.size(n),
                          {}});
    constexpr double kShort_mm = 0.5;
    if (const auto deepest_mm = files.deepest_mm(n))
      all.canals.back().deepest_mm = *deepest_mm - (canal.length_mm() - kShort_mm);
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

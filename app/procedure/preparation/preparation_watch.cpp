#include "app/procedure/preparation/preparation_watch.h"

#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include "app/procedure/root_canal/dense_tooth.h"
#include "app/text/usage_error.h"

namespace app {

struct PreparationWatch::Copy {
  assets::PreparedTooth tooth;
  ToothCopy volume;
  std::optional<PreparationMeasure> measure;  ///< from the first measurement

  Copy(const assets::PreparedTooth& of, const assets::CtVolume& scan, std::span<const std::uint8_t> before)
      : tooth(of), volume(scan, before) {
    if (!tooth.given) idealRule(tooth.ideal, "--ideal");  // whether there is one
  }

  Measured measured() try {
    if (!measure)
      measure.emplace(Crown(ToothBlocks(DenseTooth(volume.grid(), volume.before(), volume.labels())), tooth.frame),
                      tooth, "--ideal");
    const BoxBytes made(DenseSolid(volume.grid(), volume.now()), measure->crown().solid.grid());
    Measured measured{measure->outcomesOf(made), {}, {}};
    if (!volume.filling().laid.empty())
      measured.outcomes->filling = measure->fillingOf(made, laidBoxes(volume.filling(), volume.grid(), made.grid()));
    measured.paint = preparationPaint(*measure, made, *measured.outcomes);
    return measured;
  } catch (const UsageError& error) {
    return {{}, {}, error.what()};
  }
};

PreparationWatch::PreparationWatch(const assets::PreparedTooth& tooth, const assets::CtVolume& scan,
                                   std::span<const std::uint8_t> before, const haptics::Bodies& bodies)
    : copy_(std::make_unique<Copy>(tooth, scan, before)), bodies_(bodies) {
  // Of a rehearsal that goes on, all may differ from the scan.
  assets::forVoxels(glm::ivec3(0), bodies.grid().bricks(), [&](glm::ivec3 brick) { changed_.push_back(brick); });
}

PreparationWatch::~PreparationWatch() {
  if (measuring_.valid()) measuring_.wait();
}

bool PreparationWatch::follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest) {
  changed_.insert(changed_.end(), bricks.begin(), bricks.end());
  bool is_new = false;
  if (measuring_.valid()) {
    if (measuring_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    take(measuring_.get());
    is_new = true;
  }
  if (!pause_.isDue(newest, !changed_.empty())) return is_new;
  copy_->volume.take(bodies_, std::exchange(changed_, {}));
  measuring_ = std::async(std::launch::async, [copy = copy_.get()] { return copy->measured(); });
  return is_new;
}

bool PreparationWatch::measureNow() {
  if (measuring_.valid()) take(measuring_.get());
  copy_->volume.take(bodies_, std::exchange(changed_, {}));
  take(copy_->measured());
  return newest_.has_value();
}

void PreparationWatch::take(Measured measured) {
  newest_ = std::move(measured.outcomes);
  paint_ = std::move(measured.paint);
  line_ = newest_ ? preparationLine(*newest_) : measured.refusal;
}

std::string fillingLine(const FillingOutcomes& filling) {
  std::string line =
      fmt::format("{:.1f} mm³ laid, {:.0f} % of the cavity filled", filling.laid_mm3, 100.0 * filling.filledShare());
  if (filling.curable_mm3 > 0.0) line += fmt::format(", {:.0f} % cured", 100.0 * filling.curedShare());
  for (const Increment& one : filling.increments)
    if (one.isTooDeep())
      line +=
          fmt::format("; increment {} is {:.1f} mm deep, over {:g}", one.number, one.depth_mm, kDeepestIncrement_mm);
  if (!filling.voids.empty()) line += fmt::format("; voids {}", filling.voids.size());
  if (filling.overhang_mm3 > 0.005)
    line += fmt::format("; overhang {:.2f} mm³, {:.1f} mm", filling.overhang_mm3, filling.overhang_mm);
  return line;
}

std::string preparationLine(const PreparationOutcomes& outcomes) {
  if (outcomes.filling && outcomes.filling->laid_mm3 > 0.0) return fillingLine(*outcomes.filling);
  const RemovedMaterial& removed = outcomes.removed;
  const double cut_mm3 = removed.enamel_mm3 + removed.dentine_mm3;
  std::string line =
      fmt::format("{:.0f} of {:.0f} mm³ cut, {:.1f} too much", cut_mm3, removed.wanted_mm3, removed.over_mm3());
  if (outcomes.walls && std::isfinite(outcomes.walls->convergence_rad))
    line += fmt::format("; walls {:.0f}°", outcomes.walls->convergence_rad * 180.0 / std::numbers::pi);
  if (outcomes.margin && std::isfinite(outcomes.margin->mean_mm))
    line += fmt::format("; margin {:.1f} mm", outcomes.margin->mean_mm);
  if (outcomes.cavity && outcomes.cavity->isCut())
    line += fmt::format("; {:.1f} mm deep, {:.1f} mm wide", outcomes.cavity->depth_mm, outcomes.cavity->isthmus_mm);
  if (const auto& caries = outcomes.caries) {
    line += fmt::format("; soft caries {:.1f} mm³ left, firm {:.1f}; {:.1f} mm³ of sound tissue cut",
                        caries->soft_left_mm3, caries->firm_left_mm3, caries->sound_cut_mm3);
    if (std::isfinite(caries->least_over_pulp_mm))
      line += fmt::format("; {:.1f} mm over the pulp", caries->least_over_pulp_mm);
  }
  if (removed.neighbour_mm3 > 0.005) line += fmt::format("; neighbour cut, {:.2f} mm³", removed.neighbour_mm3);
  if (removed.pulp_open_mm2 > 0.0) line += fmt::format("; pulp open, {:.2f} mm²", removed.pulp_open_mm2);
  return line;
}

}  // namespace app

#include "app/procedure/root_canal/treatment_watch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/procedure/root_canal/dense_tooth.h"

namespace app {
namespace {

constexpr double kLeast_mm3 = 0.005;

}  // namespace

struct TreatmentWatch::Copy {
  const assets::ToothCanals& tooth;
  ToothCopy volume;
  std::optional<ToothBlocks> blocks;  ///< before, from the first measurement

  Copy(const assets::ToothCanals& of, const assets::CtVolume& scan, std::span<const std::uint8_t> solid_before)
      : tooth(of), volume(scan, solid_before) {}

  Measured measure(const FileUse& files) {
    const auto start = std::chrono::steady_clock::now();
    if (!blocks) blocks.emplace(DenseTooth(volume.grid(), volume.before(), volume.labels()));
    Measured measured{treatmentOf(tooth, *blocks, DenseSolid(volume.grid(), volume.now()), files)};
    measured.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return measured;
  }
};

TreatmentWatch::TreatmentWatch(const assets::ToothCanals& tooth, const assets::CtVolume& scan,
                               std::span<const std::uint8_t> before, const haptics::Bodies& bodies)
    : copy_(std::make_unique<Copy>(tooth, scan, before)), bodies_(bodies) {}

TreatmentWatch::~TreatmentWatch() {
  if (measuring_.valid()) measuring_.wait();
}

bool TreatmentWatch::follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, const FileUse& files) {
  changed_.insert(changed_.end(), bricks.begin(), bricks.end());
  bool is_new = false;
  if (measuring_.valid()) {
    if (measuring_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    Measured measured = measuring_.get();
    newest_ = std::move(measured.treatment);
    longest_s_ = std::max(longest_s_, measured.took_s);
    ++times_;
    is_new = true;
  }
  if (!pause_.isDue(newest, !changed_.empty())) return is_new;
  copy_->volume.take(bodies_, std::exchange(changed_, {}));
  measuring_ = std::async(std::launch::async, [copy = copy_.get(), files] { return copy->measure(files); });
  return is_new;
}

std::string treatmentLine(const Treatment& treatment) {
  std::string line;
  const auto add = [&](const std::string& words) { line += (line.empty() ? "" : "; ") + words; };
  for (const Perforation& hole : treatment.perforations)
    add(fmt::format("perforation, {} {:.2f} mm²", nameOf(hole.kind), hole.area_mm2));
  for (const TreatedCanal& canal : treatment.canals) {
    const CanalOutcomes& of = canal.outcomes;
    if (of.removed_mm3 < kLeast_mm3) continue;
    std::string words =
        fmt::format("{} {:.2f} mm³, {:.0f} % untouched", canal.name, of.removed_mm3, 100.0 * of.untouched);
    if (std::isfinite(of.least_wall_mm)) words += fmt::format(", wall {:.2f} mm", of.least_wall_mm);
    add(words);
  }
  if (treatment.lost.enamel_mm3 + treatment.lost.dentine_mm3 > kLeast_mm3 && treatment.filed_mm3 < kLeast_mm3) {
    add(fmt::format("{:.1f} mm³ of tooth lost, roof {:.0f} % open",
                    treatment.lost.enamel_mm3 + treatment.lost.dentine_mm3, 100.0 * treatment.roof.removed));
    if (treatment.lost.floor_mm3 > kLeast_mm3) add(fmt::format("floor gouged {:.2f} mm³", treatment.lost.floor_mm3));
  }
  return line;
}

}  // namespace app

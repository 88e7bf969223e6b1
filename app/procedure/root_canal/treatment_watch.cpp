#include "app/procedure/root_canal/treatment_watch.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/procedure/root_canal/dense_tooth.h"

namespace app {
namespace {

constexpr double kRest_s = 0.4, kBetween_s = 1.0, kBetweenAtWork_s = 10.0;
constexpr double kLeast_mm3 = 0.005;

/// Blocks want whole ones: the grid grown with air.
assets::CtVolume wholeBlocks(const assets::CtVolume& scan, std::span<const std::uint8_t> solid) {
  assets::CtVolume whole;
  whole.grid = scan.grid;
  whole.grid.size = (scan.grid.size + (FineSolid::kEdge - 1)) / FineSolid::kEdge * FineSolid::kEdge;
  whole.solid.assign(whole.grid.voxelCount(), 0);
  whole.label.assign(whole.grid.voxelCount(), 0);
  assets::forVoxels(scan.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const std::size_t to = whole.grid.index(ijk);
    whole.solid[to] = solid[v], whole.label[to] = scan.label[v];
  });
  return whole;
}

}  // namespace

struct TreatmentWatch::Copy {
  assets::CtVolume before;
  const assets::ToothCanals& tooth;
  std::vector<std::uint8_t> solid;    ///< now
  std::optional<ToothBlocks> blocks;  ///< of `before`, from the first measurement

  Copy(const assets::ToothCanals& of, const assets::CtVolume& scan, std::span<const std::uint8_t> solid_before)
      : before(wholeBlocks(scan, solid_before)), tooth(of), solid(before.solid) {}

  Measured measure(const FileUse& files) {
    const auto start = std::chrono::steady_clock::now();
    if (!blocks) blocks.emplace(DenseTooth(before.grid, before.solid, before.label));
    Measured measured{treatmentOf(tooth, *blocks, DenseSolid(before.grid, solid), files)};
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
  const double now_s = newest.t_s;
  if (newest.drilling || newest.file.stay == haptics::FileStay::wall) busy_s_ = now_s;
  const bool rests = now_s - busy_s_ > kRest_s;
  if (changed_.empty() || now_s - measured_s_ < (rests ? kBetween_s : kBetweenAtWork_s)) return is_new;
  measured_s_ = now_s;
  for (const glm::ivec3& brick : std::exchange(changed_, {})) {
    std::array<std::uint8_t, 512> bytes{};
    bodies_.jaw().copyBrick(brick, bytes);
    const glm::ivec3 low = 8 * brick;
    std::size_t n = 0;
    assets::forVoxels(low, low + 8, [&](glm::ivec3 ijk) {
      if (bodies_.grid().contains(ijk)) copy_->solid[copy_->before.grid.index(ijk)] = bytes[n];
      ++n;
    });
  }
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

#include "app/procedure/gutter_watch.h"

#include <array>
#include <chrono>
#include <utility>

#include "app/case/enamel_exposure.h"
#include "assets/cut_field.h"
#include "assets/tissue.h"

namespace app {
namespace {

constexpr double kBetweenCounts_s = 1.0;

/// Voxels of bone in the gutter, without the operated tooth.
std::vector<std::size_t> boneInGutter(const assets::Patient& patient, std::span<const std::uint8_t> before,
                                      const assets::PlannedCut& cut) {
  const assets::CtVolume& ct = patient.ct;
  const assets::CutField field(cut, 1.0);
  std::vector<std::size_t> bone;
  const glm::ivec3 low = glm::max(glm::ivec3(glm::floor(ct.grid.indexFromPoint(field.low_P_mm()))), glm::ivec3(0));
  const glm::ivec3 end = glm::min(glm::ivec3(glm::ceil(ct.grid.indexFromPoint(field.high_P_mm()))) + 1, ct.grid.size);
  assets::forVoxels(low, end, [&](glm::ivec3 ijk) {
    const std::size_t v = ct.grid.index(ijk);
    if (before[v] >= assets::kHalfSolid && !assets::isTooth(ct.label[v]) && field.contains(ct.grid.centre_P_mm(ijk)))
      bone.push_back(v);
  });
  return bone;
}

}  // namespace

/// What a count reads: the volume as it was at the last count, and what the plan opens.
struct GutterWatch::Copy {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid;
  std::vector<std::size_t> gutter;
  EnamelExposure exposure;

  Copy(const assets::Patient& patient, std::span<const std::uint8_t> before, const assets::PlannedCut& cut)
      : grid(patient.ct.grid),
        solid(before.begin(), before.end()),
        gutter(boneInGutter(patient, before, cut)),
        exposure(patient.ct, before, patient.site.value(), cut) {}

  Shares count() const {
    std::size_t gone = 0;
    for (const std::size_t v : gutter) gone += solid[v] < assets::kHalfSolid ? 1 : 0;
    return {gutter.empty() ? 1.0 : static_cast<double>(gone) / static_cast<double>(gutter.size()),
            exposure.share(solid)};
  }
};

GutterWatch::GutterWatch(const assets::Patient& patient, std::span<const std::uint8_t> before,
                         const assets::PlannedCut& cut, const haptics::Bodies& bodies)
    : copy_(std::make_unique<Copy>(patient, before, cut)), bodies_(bodies) {
  // Of a rehearsal that goes on, all bone may differ from the scan.
  assets::forVoxels(glm::ivec3(0), bodies.grid().bricks(), [&](glm::ivec3 brick) { changed_.push_back(brick); });
}

GutterWatch::~GutterWatch() {
  if (counting_.valid()) counting_.wait();
}

/// The jaw alone: the tooth's own pieces do not cover its crown.
void GutterWatch::follow(std::span<const glm::ivec3> bricks, double t_s, bool waits) {
  changed_.insert(changed_.end(), bricks.begin(), bricks.end());
  if (counting_.valid()) {
    if (counting_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    newest_ = counting_.get();
  }
  if (changed_.empty() || (counted_s_ && t_s - *counted_s_ < kBetweenCounts_s)) return;
  counted_s_ = t_s;
  for (const glm::ivec3& brick : std::exchange(changed_, {})) {
    std::array<std::uint8_t, 512> bytes{};
    bodies_.jaw().copyBrick(brick, bytes);
    const glm::ivec3 low = 8 * brick;
    std::size_t n = 0;
    assets::forVoxels(glm::ivec3(0), glm::ivec3(8), [&](glm::ivec3 at) {
      if (copy_->grid.contains(low + at)) copy_->solid[copy_->grid.index(low + at)] = bytes[n];
      ++n;
    });
  }
  counting_ = std::async(std::launch::async, [copy = copy_.get()] { return copy->count(); });
  if (waits) newest_ = counting_.get();
}

}  // namespace app

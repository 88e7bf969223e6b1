#include "app/procedure/preparation/bite_watch.h"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "app/procedure/preparation/filling_outcomes.h"
#include "app/procedure/root_canal/dense_tooth.h"
#include "app/procedure/tooth_copy.h"

namespace app {

BittenTooth::BittenTooth(Crown crown, const assets::PreparedTooth& tooth)
    : crown_(std::move(crown)), antagonist_(antagonistOf(crown_, occlusalHeights(crown_, crown_.solid), tooth)) {}

BittenTooth::Marked BittenTooth::bitten(const BoxBytes& made, double paper_mm) const {
  const OcclusalRaster heights = occlusalHeights(crown_, made);
  Marked marked{biteOn(heights, antagonist_, paper_mm), {}, box()};
  marked.spots = biteSpots(crown_, made, heights, marked.bite);
  return marked;
}

BiteRecord recordOf(const Bite& bite, double t_s) {
  BiteRecord record;
  record.t_s = t_s;
  record.paper_um = 1000.0 * bite.paper_mm;
  record.is_made = bite.is_made;
  if (bite.closing != assets::Closing::axis) record.closing = nameOf(bite.closing);
  record.is_balanced = bite.is_balanced;
  record.high_um = std::round(1000.0 * bite.open_mm);
  if (std::isfinite(bite.clearance_mm)) record.clearance_um = std::round(1000.0 * bite.clearance_mm);
  if (bite.first_mm) record.first = placeName(*bite.first_mm);
  for (const BiteContact& contact : bite.contacts)
    record.contacts.push_back({placeName(contact.place_mm), std::round(1000.0 * contact.area_mm2) / 1000.0,
                               std::round(1000.0 * contact.gap_mm)});
  return record;
}

struct BiteWatch::Copy {
  const assets::PreparedTooth& prepared;
  const assets::CtVolume& scan;
  std::span<const std::uint8_t> before;
  // From the first bite.
  std::optional<ToothCopy> volume;
  std::optional<BittenTooth> tooth;

  BittenTooth::Marked marked(double paper_mm) {
    const assets::VolumeGrid& grid = volume->grid();
    if (!tooth)
      tooth.emplace(Crown(ToothBlocks(DenseTooth(grid, volume->before(), volume->labels())), prepared.frame), prepared);
    const BoxBytes made(DenseSolid(grid, volume->now()), tooth->box());
    return tooth->bitten(filledTooth(made, volume->filling(), grid), paper_mm);
  }
};

BiteWatch::BiteWatch(const assets::PreparedTooth& tooth, const assets::CtVolume& scan,
                     std::span<const std::uint8_t> before, const haptics::Bodies& bodies, double paper_mm)
    : copy_(std::make_unique<Copy>(tooth, scan, before)), bodies_(bodies), paper_mm_(paper_mm) {}

BiteWatch::~BiteWatch() {
  if (marking_.valid()) marking_.wait();
}

std::string BiteWatch::close(const haptics::Tick& newest, bool waits) {
  if (newest.drilling) return "stop the bur first, then bite";
  if (marking_.valid()) return "the jaws are closing";
  std::vector<glm::ivec3> all;
  assets::forVoxels(glm::ivec3(0), bodies_.grid().bricks(), [&](glm::ivec3 brick) { all.push_back(brick); });
  if (!copy_->volume) copy_->volume.emplace(copy_->scan, copy_->before);
  copy_->volume->take(bodies_, all);
  closed_at_s_ = newest.t_s + 0.5 * newest.dt_s;
  marking_ = std::async(waits ? std::launch::deferred : std::launch::async,
                        [copy = copy_.get(), paper_mm = paper_mm_] { return copy->marked(paper_mm); });
  if (waits) take();
  return {};
}

void BiteWatch::take() {
  marked_ = marking_.get();
  record_ = recordOf(marked_->bite, closed_at_s_);
  is_new_ = true;
}

bool BiteWatch::follow() {
  if (marking_.valid() && marking_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) take();
  return std::exchange(is_new_, false);
}

}  // namespace app

#include "app/session/measures/bone_measures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/session/measures/outcome.h"
#include "app/session/measures/plan_comparison.h"
#include "assets/tissue.h"
#include "haptics/body/components.h"

namespace app {
namespace {

constexpr int kBlock = 4;

/// Of a body's number of blocks in each direction.
glm::ivec3 blockAt(std::size_t number, glm::ivec3 blocks) {
  const auto x = static_cast<std::size_t>(blocks.x), y = static_cast<std::size_t>(blocks.y);
  return {static_cast<int>(number % x), static_cast<int>(number / x % y), static_cast<int>(number / (x * y))};
}

}  // namespace

/// What is in the mouth of a voxel: jaw and the pieces that are not set aside.
struct BoneMeasures::Bones {
  explicit Bones(const haptics::Bodies& bodies)
      : jaw(bodies.jaw().field()), first(bodies.firstBrick() * assets::kBrickVoxels) {
    for (std::size_t n = 0; n + 1 < bodies.bones().size(); ++n)
      if (!bodies.isSetAside(n)) pieces.push_back(bodies.bones()[n + 1].field());
    if (bodies.bones().size() > 1) piece_size = bodies.bones()[1].grid().size;
  }
  std::uint8_t solidAt(glm::ivec3 ijk) const {
    int solid = jaw.solidAt(ijk);
    const glm::ivec3 own = ijk - first;
    if (glm::all(glm::greaterThanEqual(own, glm::ivec3(0))) && glm::all(glm::lessThan(own, piece_size)))
      for (const haptics::SolidField& piece : pieces) solid = std::min(255, solid + piece.solidAt(own));
    return static_cast<std::uint8_t>(solid);
  }

  haptics::SolidField jaw;
  glm::ivec3 first, piece_size{0};
  std::vector<haptics::SolidField> pieces;
};

BoneMeasures::BoneMeasures(const StoredStart& start, const SessionCase& about, const haptics::Bodies& bodies,
                           std::vector<std::string> ids)
    : start_(start),
      about_(about),
      ids_(std::move(ids)),
      values_(ids_.size()),
      asks_plan_((asks("O2.") || asks("O3.") || asks("O4.")) && about.from_plan_mm),
      after_(bodies.solidInMouth()),
      every_(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::lround(kBetween_s / start.dt_s)))) {
  for (const std::string& id : ids_)
    if (!id.starts_with("O1.") && !id.starts_with("O2.") && !id.starts_with("O3.") && !id.starts_with("O10."))
      whole_ids_.push_back(id);
  if (asks("O7.") || asks("O8.")) surface_.emplace(start.grid, start.solid);
  if (asks("O1.")) zones_ = zonesOfCase(start, about);
  blocks_ = (start.grid.size + kBlock - 1) / kBlock;
  place_.assign(assets::countIn(blocks_), -1);
  const int fdi = start.setup.site ? start.setup.site->fdi - 1 : 0;
  has_second_molar_ = start.setup.site && std::ranges::find(start.teeth, fdi) != start.teeth.end();
  if (!asks_plan_) return;
  const double voxel_mm3 = start.grid.voxelVolume_mm3();
  assets::forVoxels(start.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (start.solid[v] == 0 || !countsAsBone(start.label[v])) return;
    const double from_plan_mm = about.from_plan_mm(start.grid.centre_P_mm(ijk));
    planned_mm3_ += shareInPlan(from_plan_mm, start.grid.spacing_mm) * start.solid[v] / 255.0 * voxel_mm3;
  });
}

bool BoneMeasures::asks(std::string_view beginning) const {
  return std::ranges::any_of(ids_, [&](const std::string& id) { return id.starts_with(beginning); });
}

BoneMeasures::Touched& BoneMeasures::touchedAt(glm::ivec3 block) {
  std::int32_t& place = place_[assets::indexIn(blocks_, block)];
  if (place >= 0) return touched_[static_cast<std::size_t>(place)];
  place = static_cast<std::int32_t>(touched_.size());
  Touched& made = touched_.emplace_back();
  made.first = kBlock * block;
  if (!asks_plan_) return made;
  std::size_t within = 0;
  assets::forVoxels(made.first, made.first + kBlock, [&](glm::ivec3 ijk) {
    const std::size_t n = within++;
    if (!start_.grid.contains(ijk)) return;
    const std::size_t v = start_.grid.index(ijk);
    if (start_.solid[v] == 0 || !countsAsBone(start_.label[v])) return;
    made.from_plan_mm[n] = about_.from_plan_mm(start_.grid.centre_P_mm(ijk));
    made.planned[n] = shareInPlan(made.from_plan_mm[n], start_.grid.spacing_mm) * start_.solid[v] / 255.0;
  });
  return made;
}

void BoneMeasures::addChange(const Touched& touched, std::size_t within, glm::ivec3 ijk, std::size_t v,
                             std::uint8_t now) {
  const double was = lostShare(start_.solid[v], after_[v]), is = lostShare(start_.solid[v], now);
  if (has_second_molar_ && start_.teeth[v] == start_.setup.site->fdi - 1) second_molar_ += is - was;
  if (!countsAsBone(start_.label[v])) return;
  bone_ += is - was;
  if (zones_) by_zone_[static_cast<std::size_t>(zones_->at(start_.grid.centre_P_mm(ijk)))] += is - was;
  if (asks_plan_) both_ += std::min(is, touched.planned[within]) - std::min(was, touched.planned[within]);
}

void BoneMeasures::follow(const Bones& bones, glm::ivec3 block, std::optional<double> cut_s) {
  Touched* touched = nullptr;
  std::size_t within = 0;
  assets::forVoxels(kBlock * block, kBlock * block + kBlock, [&](glm::ivec3 ijk) {
    const std::size_t n = within++;
    if (!start_.grid.contains(ijk)) return;
    const std::size_t v = start_.grid.index(ijk);
    const std::uint8_t now = bones.solidAt(ijk);
    if (now == after_[v]) return;
    if (touched == nullptr) touched = &touchedAt(block);
    if (cut_s && now < after_[v] && !touched->t_s[n]) touched->t_s[n] = cut_s;
    addChange(*touched, n, ijk, v, now);
    after_[v] = now;
    is_changed_ = true;
  });
}

/// `anew`: a piece was set aside or came back.
void BoneMeasures::collect(haptics::Bodies& bodies, bool anew, std::optional<double> cut_s) {
  const Bones bones(bodies);
  const glm::ivec3 first_block = bones.first / kBlock;
  for (std::size_t n = 0; n < bodies.bones().size(); ++n) {
    haptics::CarvedBone& bone = bodies.bones()[n];
    written_.clear();
    bone.takeWritten(written_);
    const glm::ivec3 own = (bone.grid().size + kBlock - 1) / kBlock;
    for (const std::size_t block : written_)
      follow(bones, blockAt(block, own) + (n == 0 ? glm::ivec3(0) : first_block), cut_s);
  }
  if (!anew || bodies.bones().size() < 2) return;
  const glm::ivec3 own = (bones.piece_size + kBlock - 1) / kBlock;
  assets::forVoxels(first_block, glm::min(first_block + own, blocks_),
                    [&](glm::ivec3 block) { follow(bones, block, {}); });
}

void BoneMeasures::add(const haptics::Tick& tick, const haptics::Command& in_force, haptics::Bodies& bodies) {
  if (!parted_s_ && (tick.broken.piece != 0 || (tick.pieces > 1 && digest_ && pieces_ < 2))) parted_s_ = tick.t_s;
  pieces_ = tick.pieces;
  if (digest_ != tick.bone_digest) {
    std::array<bool, haptics::kMaxPieces> aside{};
    for (std::size_t n = 0; n < tick.pieces; ++n) aside[n] = haptics::Bodies::isAside(tick.X_PQ[n]);
    const bool anew = std::exchange(aside_, aside) != aside;
    const bool cuts = tick.drilling && in_force.tool.turns() && tick.removed_mm3 > 0.0;
    collect(bodies, anew, cuts ? std::optional(tick.t_s) : std::nullopt);
    if (anew) is_changed_ = true;
    digest_ = tick.bone_digest;
    tellSums(tick);
  }
  if (!whole_ids_.empty() && is_changed_ && tick.index % every_ == 0) tellWhole(tick, bodies);
}

void BoneMeasures::tell(std::string_view id, std::optional<double> value) {
  for (std::size_t n = 0; n < ids_.size(); ++n)
    if (ids_[n] == id) values_[n] = value;
}

void BoneMeasures::tellSums(const haptics::Tick& tick) {
  const double voxel_mm3 = start_.grid.voxelVolume_mm3();
  double tooth_mm3 = 0.0;
  for (std::size_t n = 0; n < assets::kTissues.size(); ++n)
    if (assets::kTissues[n].tooth) tooth_mm3 += tick.removed_total_mm3[n];
  tell("O1.bone", bone_ * voxel_mm3);
  tell("O1.tooth", tooth_mm3);
  for (std::size_t zone = 0; zones_ && zone < kZones; ++zone) tell(kZoneMeasures[zone], by_zone_[zone] * voxel_mm3);
  if (has_second_molar_) tell("O10.second_molar", second_molar_ * voxel_mm3);
  if (!asks_plan_ || !(planned_mm3_ > 0.0)) return;
  PlanComparison found;
  found.removed_mm3 = bone_ * voxel_mm3, found.planned_mm3 = planned_mm3_, found.both_mm3 = both_ * voxel_mm3;
  tell("O2.plan", found.both_mm3 / found.planned_mm3);
  tell("O3.planned", found.planned_mm3);
  tell("O3.over", found.over_mm3());
  tell("O3.under", found.under_mm3());
  tell("O3.dice", found.dice());
}

void BoneMeasures::tellWhole(const haptics::Tick& tick, const haptics::Bodies& bodies) {
  is_changed_ = false;
  std::vector<RemovedVoxel> removed;
  PlanComparison outside;
  std::vector<std::pair<double, double>> over;  // distance, volume
  for (const Touched& touched : touched_) {
    std::size_t within = 0;
    assets::forVoxels(touched.first, touched.first + kBlock, [&](glm::ivec3 ijk) {
      const std::size_t n = within++;
      if (!start_.grid.contains(ijk)) return;
      const std::size_t v = start_.grid.index(ijk);
      const double share = lostShare(start_.solid[v], after_[v]);
      if (!(share > 0.0)) return;
      removed.push_back({ijk, v, share, touched.t_s[n]});
      if (!asks_plan_ || !countsAsBone(start_.label[v])) return;
      const double off_mm = touched.from_plan_mm[n], part = share - std::min(share, touched.planned[n]);
      if (isOverCut(part, off_mm)) over.emplace_back(off_mm + 0.5 * start_.grid.spacing_mm, part);
    });
  }
  tellOverCut(std::move(over), outside);
  tell("O4.mean", outside.over_mean_mm);
  tell("O4.p95", outside.over_p95_mm);
  tell("O4.max", outside.over_max_mm);
  if (!asks("O5.") && !asks("O6.") && !asks("O7.") && !asks("O8.") && !asks("O9.") && !asks("O11.")) return;

  std::ranges::sort(removed, {}, &RemovedVoxel::index);
  const RemovalClock clock(start_.grid, std::move(removed));
  std::optional<SocketRecord> socket;
  if (std::ranges::find(aside_, true) != aside_.end() && asks("O11.")) {
    socket.emplace();
    const assets::VolumeGrid& grid = bodies.bones()[1].grid();
    std::vector<std::uint8_t> tooth(grid.voxelCount(), 0);
    for (std::size_t n = 0; n < tick.pieces; ++n) {
      if (aside_[n]) continue;
      const std::vector<std::uint8_t> piece = bodies.bones()[n + 1].solidInGridOrder();
      for (std::size_t v = 0; v < tooth.size(); ++v)
        tooth[v] = static_cast<std::uint8_t>(std::min(255, tooth[v] + piece[v]));
    }
    for (const haptics::ToothPiece& part : haptics::Components(grid, tooth).pieces())
      if (part.volume_mm3 >= haptics::kLeastPiece_mm3) socket->retained.push_back({part.volume_mm3, part.centroid_mm});
  }
  std::vector<std::string> wanted;
  for (const std::string& id : whole_ids_)
    if (!id.starts_with("O4.")) wanted.push_back(id);
  for (const MeasureValue& value :
       outcomeMeasures({start_, after_, clock, surface_ ? &*surface_ : nullptr, about_, socket, parted_s_, {}, wanted}))
    if (std::ranges::find(wanted, value.id) != wanted.end()) tell(value.id, value.value);
}

}  // namespace app

#include "app/procedure/third_molar/operation_planner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "app/case/operated_crown.h"
#include "app/case/risk_structures.h"
#include "app/procedure/third_molar/clearing_plan.h"
#include "app/procedure/third_molar/section_choice.h"
#include "app/procedure/third_molar/section_plan.h"
#include "assets/tissue.h"
#include "assets/tooth.h"
#include "haptics/body/components.h"

namespace app {
namespace {

// Our defaults, found on the built-in cases.
constexpr double kLeastTaken_mm3 = 5.0;                            ///< smaller ones wait for the end
constexpr int kMostFragments = 3;                                  ///< tries, at the end
constexpr std::array kOvershoot_mm = {0.7, 1.1, 1.5, 1.9};         ///< of the first section, the second, …
constexpr std::array kOffTooth_mm = {0.1, 0.1, -0.5, -0.9, -1.2};  ///< of the first clearing, the second, …
/// Nearer to the canal is an error of the shipped steps: clearing keeps off at first.
constexpr Margins kCareful{2.1, 0.45};
constexpr int kCarefulTries = 2;
/// A section that would open the tongue's side stops short of it, and what is left is broken with the elevator.
constexpr double kSafeTongue_mm = 0.3, kOffTongue_mm = 0.36;
constexpr int kSparedBeforeTwist = 2;  ///< sections; the first leaves a rough floor
constexpr double kBroken_mm3 = 5.0;    ///< of the largest piece: a twist broke something
constexpr double kMuchLess = 0.8;      ///< in the way of the pieces, for a section of the broader tooth
constexpr int kPasses = static_cast<int>(kOvershoot_mm.size());
constexpr double kParted = 0.65;  ///< of the whole tooth: its largest piece when it is parted
constexpr int kMostTries = 9;
constexpr double kTried_mm3 = 10.0;    ///< with no more in its way than this, a piece is pulled at before more is cut
constexpr double kSmall_mm3 = 30.0;    ///< a piece of less waits for the others once it was pulled at
constexpr double kSamePiece_mm = 2.0;  ///< that its middle may have moved
constexpr double kGripped_mm = 2.0;    ///< radius between the beaks
constexpr int kGripStep = 2;           ///< voxels from place to place that is looked at

bool isSolid(std::uint8_t solid) { return solid >= assets::kHalfSolid; }

/// Along the deepest of its strokes, the longest of those.
std::optional<SplitStep> slotOf(const assets::PlannedCut& cut) {
  constexpr double kAlike_mm = 0.3;
  const glm::dvec3 out = glm::normalize(cut.outward_P);
  std::optional<SplitStep> slot;
  double deepest_mm = 1e9, longest_mm = 0.0;
  for (const auto& stroke : cut.strokes_P_mm)
    for (std::size_t n = 0; n + 1 < stroke.size(); ++n) {
      const glm::dvec3 middle = 0.5 * (stroke[n] + stroke[n + 1]);
      glm::dvec3 along = stroke[n + 1] - stroke[n];
      along -= glm::dot(along, out) * out;
      const double height_mm = glm::dot(middle, out), length_mm = glm::length(along);
      const bool is_deeper = height_mm < deepest_mm - kAlike_mm;
      if (length_mm < kAlike_mm || (!is_deeper && (height_mm > deepest_mm + kAlike_mm || length_mm <= longest_mm)))
        continue;
      deepest_mm = std::min(deepest_mm, height_mm);
      longest_mm = length_mm;
      slot = SplitStep{middle, along / length_mm, out};
    }
  return slot;
}

/// Of the places in a piece at which the beaks do not meet bone, the one with the most of it between them; the higher
/// the better. Where there is none, its highest place.
glm::dvec3 gripOf(const assets::CtVolume& now, const assets::VolumeGrid& grid, const haptics::Components& tooth,
                  int component, std::span<const std::uint8_t> jaw, const glm::dvec3& out_P) {
  const int reach = static_cast<int>(std::ceil(kGripped_mm / grid.spacing_mm));
  glm::dvec3 best_P_mm(0.0), highest_P_mm = tooth.pieces()[static_cast<std::size_t>(component)].centroid_mm;
  double most = -1e9, highest_mm = -1e9;
  assets::forVoxels(glm::ivec3(0), grid.size / kGripStep, [&](glm::ivec3 coarse) {
    const glm::ivec3 ijk = coarse * kGripStep;
    if (tooth.pieceAt(ijk) != component) return;
    const glm::dvec3 p = grid.centre_P_mm(ijk);
    const double height_mm = glm::dot(p, out_P);
    if (height_mm > highest_mm) highest_mm = height_mm, highest_P_mm = p;
    int own = 0, bone = 0;
    const glm::ivec3 in_jaw(glm::round(now.grid.indexFromPoint(p)));
    assets::forVoxels(glm::ivec3(-reach), glm::ivec3(reach + 1), [&](glm::ivec3 off) {
      if (glm::dot(glm::dvec3(off), glm::dvec3(off)) > double(reach * reach)) return;
      own += grid.contains(ijk + off) && tooth.pieceAt(ijk + off) == component ? 1 : 0;
      bone += now.grid.contains(in_jaw + off) && isSolid(jaw[now.grid.index(in_jaw + off)]) ? 1 : 0;
    });
    if (bone > 0) return;
    const double worth = own * std::pow(grid.spacing_mm, 3) + 3.0 * height_mm;
    if (worth > most) most = worth, best_P_mm = p;
  });
  return most > -1e9 ? best_P_mm : highest_P_mm;
}

/// Where what lies beyond the jaw's outer surface towards the tongue begins, as scanned.
std::vector<glm::dvec3> tongueSide_P_mm(const assets::Patient& patient) {
  const std::vector<std::uint8_t> beyond = voxelsOf(assets::RiskStructure::lingual, patient);
  const assets::VolumeGrid& grid = patient.ct.grid;
  std::vector<glm::dvec3> surface_P_mm;
  if (beyond.empty()) return surface_P_mm;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (beyond[v] == 0) return;
    const auto is_bone = [&](glm::ivec3 off) {
      return grid.contains(ijk + off) && assets::isHard(patient.ct.label[grid.index(ijk + off)]);
    };
    if (is_bone({1, 0, 0}) || is_bone({-1, 0, 0}) || is_bone({0, 1, 0}) || is_bone({0, -1, 0}) || is_bone({0, 0, 1}) ||
        is_bone({0, 0, -1}))
      surface_P_mm.push_back(grid.centre_P_mm(ijk));
  });
  return surface_P_mm;
}

}  // namespace

OperationPlanner::OperationPlanner(const assets::Patient& patient, double bur_radius_mm, bool with_elevator)
    : tongue_P_mm_(tongueSide_P_mm(patient)),
      bur_radius_mm_(bur_radius_mm),
      with_elevator_(with_elevator),
      up_(wayUp(patient)) {
  up_.is_roomy = true;
  now_.ct = patient.ct;
  now_.site = patient.site;
  now_.mandibular_canal_P_mm = patient.mandibular_canal_P_mm;
  now_.mandibular_canal_radius_mm = patient.mandibular_canal_radius_mm;
}

OperationStep OperationPlanner::cutStep(assets::PlannedCut cut, std::string words) {
  // A shaft along the way in has the room that the head has cut.
  cut.shaft_P = cut.outward_P;
  return {CutStep{std::move(cut)}, std::move(words)};
}

bool OperationPlanner::isParted(double largest_mm3) const { return largest_mm3 < kParted * whole_mm3_; }

bool OperationPlanner::isStuck(const haptics::ToothPiece& piece) const {
  return std::ranges::any_of(
      pulled_P_mm_, [&](const glm::dvec3& pulled) { return glm::distance(pulled, piece.centroid_mm) < kSamePiece_mm; });
}

bool OperationPlanner::findAgain(Tried& tried, const haptics::Components& tooth, std::size_t pieces) {
  for (std::size_t n = 0; n < pieces; ++n) {
    if (glm::distance(tooth.pieces()[n].centroid_mm, tried.centroid_P_mm) > kSamePiece_mm) continue;
    tried.way.piece = n;
    return true;
  }
  return false;
}

OperationStep OperationPlanner::deliver(const PieceWay& way, const BodiesCopy& bodies,
                                        const assets::VolumeGrid& piece_grid, const haptics::Components& tooth) const {
  DeliveryStep step;
  step.out_P = up_.direction_P;
  if (up_.arch) step.rock_axis_P = up_.arch->distal_P;
  // The body that holds most of this component.
  std::array<std::size_t, haptics::kMaxPieces> shared{};
  assets::forVoxels(piece_grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (tooth.pieceAt(ijk) != static_cast<int>(way.piece)) return;
    for (std::size_t n = 0; n < shared.size(); ++n)
      shared[n] += !bodies.piece[n].empty() && isSolid(bodies.piece[n][v]) ? 1 : 0;
  });
  step.piece = static_cast<std::size_t>(std::ranges::max_element(shared) - shared.begin());
  for (const haptics::PiecePose& moved : way.way.path_X_PQ)
    step.path_X_PQ.push_back({moved.rotation * bodies.X_PQ[step.piece].rotation,
                              moved.rotation * bodies.X_PQ[step.piece].translation_mm + moved.translation_mm});
  step.grip_P_mm =
      gripOf(now_.ct, piece_grid, tooth, static_cast<int>(way.piece), bodies.jaw, glm::normalize(step.out_P));
  const double volume_mm3 = tooth.pieces()[way.piece].volume_mm3;
  return {step, fmt::format("take out the piece of {:.{}f} mm³", volume_mm3, volume_mm3 < kLeastTaken_mm3 ? 1 : 0)};
}

assets::Patient OperationPlanner::withToothOf(std::span<const std::uint8_t> tooth_solid,
                                              const assets::VolumeGrid& piece_grid, glm::ivec3 first_voxel) const {
  assets::Patient patient = now_;
  assets::CtVolume& ct = patient.ct;
  const int fdi = patient.site->fdi;
  assets::forVoxels(piece_grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (!isSolid(tooth_solid[v]) || !ct.grid.contains(ijk + first_voxel)) return;
    const std::size_t here = ct.grid.index(ijk + first_voxel);
    if (isOfTooth(ct, here, fdi)) return;
    if (!ct.tooth.empty()) ct.tooth[here] = static_cast<std::uint8_t>(fdi);
    ct.label[here] = static_cast<std::uint8_t>(assets::Tissue::dentine);
  });
  return patient;
}

std::optional<PlannedSection> OperationPlanner::planned(const SiteSolid& site, int pass,
                                                        std::optional<double> tongue_mm) const {
  const double overshoot_mm = kOvershoot_mm[static_cast<std::size_t>(pass)];
  std::optional<PlannedSection> section;
  for (const double canal_mm : {kCareful.canal_mm, Margins{}.canal_mm}) {
    section = planSection(site, bur_radius_mm_, overshoot_mm, {canal_mm, tongue_mm});
    if (section && isParted(section->largest_mm3)) break;
  }
  return section;
}

std::optional<double> OperationPlanner::inTheWayOf(const assets::Patient& patient, const UncutSite& uncut) const {
  const SiteSolid site(patient, tongue_P_mm_);
  const auto through = planned(site, 0, std::nullopt);
  if (!through) return {};
  const bool spares = with_elevator_ && through->off_tongue_mm < kSafeTongue_mm;
  const auto cut = spares ? planned(site, 0, kOffTongue_mm) : std::nullopt;
  return inTheWayAfter_mm3(uncut, cut ? cut->cut : through->cut, through->cut, kParted);
}

std::optional<assets::PlannedCut> OperationPlanner::nextSection(const assets::Patient& patient) {
  const SiteSolid site(patient, tongue_P_mm_);
  if (is_twist_due_ && !slots_.empty()) return {};
  // What one overshoot has nothing left to cut of, the next may.
  std::optional<PlannedSection> section;
  while (through_ < kPasses && !(section = planned(site, through_, std::nullopt))) ++through_;
  if (with_elevator_ && section && section->off_tongue_mm < kSafeTongue_mm && spared_ < kPasses) {
    if (auto spares = planned(site, spared_, kOffTongue_mm)) {
      ++spared_;
      is_cut_ = true;
      is_twist_due_ = spared_ >= kSparedBeforeTwist;
      if (const auto slot = slotOf(spares->cut)) slots_.push_back(*slot);
      return std::move(spares->cut);
    }
  }
  // The elevator first, where a cut has spared the tongue's side.
  if (spared_ > 0 && !slots_.empty()) return {};
  if (through_ < kPasses) ++through_;
  if (!section) return {};
  is_cut_ = true;
  if (with_elevator_)
    if (const auto slot = slotOf(section->cut)) slots_.push_back(*slot);
  return std::move(section->cut);
}

std::optional<OperationStep> OperationPlanner::takeFragment(const BodiesCopy& bodies,
                                                            const assets::VolumeGrid& piece_grid,
                                                            const haptics::Components& tooth) {
  const auto count = static_cast<std::size_t>(std::ranges::count_if(
      tooth.pieces(), [](const haptics::ToothPiece& piece) { return piece.volume_mm3 >= haptics::kLeastPiece_mm3; }));
  if (count == 0 || fragments_tried_ == kMostFragments) return {};
  ++fragments_tried_;
  const AroundTooth around{now_.ct.grid, bodies.jaw, now_.ct.label, now_.ct.tooth};
  return deliver(waysOut(around, tooth, count, up_).front(), bodies, piece_grid, tooth);
}

OperationStep OperationPlanner::twist(const SplitStep& slot, double largest_mm3) {
  twisted_ = slot;
  twisted_mm3_ = largest_mm3;
  return {slot, "break what holds it with an elevator in the slot"};
}

OperationStep OperationPlanner::next(const BodiesCopy& bodies, const assets::VolumeGrid& piece_grid,
                                     glm::ivec3 first_voxel) {
  // All that is left, as one volume; the tooth apart.
  const std::vector<std::uint8_t> tooth_solid = piecesOf(bodies, piece_grid);
  now_.ct.solid = bodies.jaw;
  assets::forVoxels(piece_grid, [&](glm::ivec3 ijk, std::size_t v) {
    int sum = 0;
    for (const auto& piece : bodies.piece) sum += piece.empty() ? 0 : piece[v];
    if (sum == 0 || !now_.ct.grid.contains(ijk + first_voxel)) return;
    std::uint8_t& here = now_.ct.solid[now_.ct.grid.index(ijk + first_voxel)];
    here = static_cast<std::uint8_t>(std::min(here + sum, 255));
  });
  const haptics::Components tooth(piece_grid, tooth_solid);
  const auto pieces = static_cast<std::size_t>(std::ranges::count_if(
      tooth.pieces(), [](const haptics::ToothPiece& piece) { return piece.volume_mm3 >= kLeastTaken_mm3; }));
  if (pieces == 0) {
    if (auto last = takeFragment(bodies, piece_grid, tooth)) return *last;
    return {EndStep{}, "the tooth is out"};
  }
  if (pieces != pieces_left_) {
    tries_ = 0;
    was_tried_ = false;
    tried_.reset();
    pulled_P_mm_.clear();
  }
  pieces_left_ = pieces;

  // A corner that broke off does not make it parted.
  if (whole_mm3_ == 0.0) whole_mm3_ = tooth.pieces()[0].volume_mm3;
  const bool is_parted = isParted(tooth.pieces()[0].volume_mm3);
  const bool is_whole = pieces == 1 && !bodies.is_any_out;
  if (!is_parted) {
    // Where a part broke off, another bridge may hold the rest.
    const double largest_mm3 = tooth.pieces()[0].volume_mm3;
    if (twisted_ && largest_mm3 < twisted_mm3_ - kBroken_mm3) return twist(*twisted_, largest_mm3);
    twisted_.reset();
    const auto broad = [&] { return withToothOf(tooth_solid, piece_grid, first_voxel); };
    if (!is_cut_) {
      const AroundTooth around{now_.ct.grid, bodies.jaw, now_.ct.label, now_.ct.tooth};
      const UncutSite uncut{around, piece_grid, tooth_solid, up_};
      const auto by_labels_mm3 = inTheWayOf(now_, uncut), broad_mm3 = inTheWayOf(broad(), uncut);
      is_broad_ = broad_mm3 && (!by_labels_mm3 || *broad_mm3 < kMuchLess * *by_labels_mm3);
    }
    auto cut = is_broad_ ? nextSection(broad()) : nextSection(now_);
    if (!cut && slots_.empty() && !is_broad_ && is_whole)
      if (const assets::Patient broader = broad(); broader.ct.label != now_.ct.label) {
        is_broad_ = true;
        spared_ = through_ = 0;
        cut = nextSection(broader);
      }
    if (cut) return cutStep(std::move(*cut), "part the tooth");
    // Where no bur may go. A break before leaves pieces that are harder to deliver than those of the planned slot.
    if (!slots_.empty()) {
      const SplitStep slot = slots_.back();
      slots_.pop_back();
      is_twist_due_ = false;
      return twist(slot, largest_mm3);
    }
    if (is_whole)
      return {EndStep{is_cut_ ? "it did not come apart" : "no bur reaches through it"}, "the tooth stays whole"};
  }

  // Bone that is in the way is looked for at a distance from the nerve and the tongue first.
  const bool is_careful = tries_ < kCarefulTries;
  const SiteSolid site(now_, tongue_P_mm_);
  const Margins margins = is_careful ? kCareful : Margins{};
  const int tries = tries_++;
  const double off_tooth_mm = kOffTooth_mm[std::min(static_cast<std::size_t>(tries), kOffTooth_mm.size() - 1)];
  if (tried_ && findAgain(*tried_, tooth, pieces)) {
    if (tried_->is_cleared) return deliver(std::exchange(tried_, std::nullopt)->way, bodies, piece_grid, tooth);
    if (auto cut = planClearing(site, tried_->way.blockers_P_mm, bur_radius_mm_, off_tooth_mm, margins)) {
      tried_->is_cleared = true;
      return cutStep(std::move(*cut), "take away what held the piece");
    }
  }
  tried_.reset();

  // The piece with the least in its way, as things are: those that wait for another do not count.
  const AroundTooth around{now_.ct.grid, bodies.jaw, now_.ct.label, now_.ct.tooth};
  std::vector<PieceWay> ways = waysOut(around, tooth, pieces, up_);
  const auto is_stuck = [&](std::size_t piece) { return isStuck(tooth.pieces()[piece]); };
  std::erase_if(ways, [&](const PieceWay& one) { return !std::ranges::all_of(one.after, is_stuck); });
  const PieceWay& way = *std::ranges::min_element(
      ways, {}, [&](const PieceWay& one) { return std::pair(is_stuck(one.piece), one.way.in_the_way_mm3); });
  if (tries >= kMostTries) return {EndStep{wordsOf(way)}, wordsOf(way)};
  const bool is_free = way.way.in_the_way_mm3 < haptics::kBlocked_mm3;
  if (is_free || (!was_tried_ && way.way.in_the_way_mm3 < kTried_mm3)) {
    if (!was_tried_) tried_ = Tried{way, tooth.pieces()[way.piece].centroid_mm, false};
    was_tried_ = true;
    if (const haptics::ToothPiece& pulled = tooth.pieces()[way.piece]; pulled.volume_mm3 < kSmall_mm3)
      pulled_P_mm_.push_back(pulled.centroid_mm);
    return deliver(way, bodies, piece_grid, tooth);
  }
  auto cut = planClearing(site, way.blockers_P_mm, bur_radius_mm_, off_tooth_mm, margins);
  if (!cut) return deliver(way, bodies, piece_grid, tooth);
  return cutStep(std::move(*cut), fmt::format("take away what blocks a piece: {}", wordsOf(way)));
}

}  // namespace app

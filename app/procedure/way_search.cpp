#include "app/procedure/way_search.h"

#include <algorithm>
#include <utility>

#include "app/procedure/piece_names.h"
#include "assets/ct_volume.h"
#include "assets/tissue.h"

namespace app {
namespace {

constexpr double kLooseRest_mm3 = 5.0;  ///< smaller ones are left to the suction
constexpr double kFirstWay_mm = 5.0;    ///< of the way out: what is said of it

bool isEnamel(std::uint8_t label) { return label == static_cast<std::uint8_t>(assets::Tissue::enamel); }

/// As it begins.
glm::dvec3 firstWay(const haptics::WayOut& way, const glm::dvec3& middle_P_mm) {
  glm::dvec3 by_mm(0.0);
  for (const auto& X_PQ : way.path_X_PQ) {
    by_mm = (X_PQ * calibration::Point<calibration::Piece>{middle_P_mm}).mm - middle_P_mm;
    if (glm::length(by_mm) >= kFirstWay_mm) break;
  }
  return by_mm;
}

KeptIn answerOf(haptics::WayOutAnswer answer) {
  switch (answer) {
    case haptics::WayOutAnswer::free:
      return KeptIn::free;
    case haptics::WayOutAnswer::grazes:
      return KeptIn::tightly;
    case haptics::WayOutAnswer::blocked:
      return KeptIn::held;
    case haptics::WayOutAnswer::not_found:
      break;
  }
  return KeptIn::not_found;
}

/// "piece 1" by its name.
std::string keeperName(const std::string& words, const std::vector<std::string>& names) {
  for (std::size_t n = 0; n < names.size(); ++n)
    if (words == "piece " + std::to_string(n)) return "the " + names[n];
  return words;
}

}  // namespace

WaySearch::WaySearch(const assets::Patient& patient, const haptics::Bodies& bodies)
    : patient_(patient),
      up_(wayUp(patient)),
      piece_grid_(bodies.bones()[1].grid()),
      label_(bodies.bones()[1].labelInGridOrder()) {
  double voxels = 0.0;
  assets::forVoxels(piece_grid_, [&](glm::ivec3 ijk, std::size_t v) {
    if (label_.empty() || !assets::isToothPart(label_[v])) return;
    enamel_voxels_ += isEnamel(label_[v]) ? 1.0 : 0.0;
    voxels += 1.0;
    middle_P_mm_ += piece_grid_.centre_P_mm(ijk);
  });
  if (voxels > 0.0) middle_P_mm_ /= voxels;
}

/// A voxel's label lies where it was before its piece moved.
std::vector<std::string> WaySearch::namesOf(const BodiesCopy& bodies, const haptics::Components& tooth,
                                            std::size_t count, bool is_whole) const {
  std::array<calibration::Pose<calibration::Piece, calibration::Patient>, haptics::kMaxPieces> X_QP;
  for (std::size_t n = 0; n < X_QP.size(); ++n) X_QP[n] = bodies.X_PQ[n].inverse();
  std::vector<double> enamel(count, 0.0);
  assets::forVoxels(piece_grid_, [&](glm::ivec3 ijk, std::size_t v) {
    const int component = tooth.pieceAt(ijk);
    if (component < 0 || static_cast<std::size_t>(component) >= count) return;
    std::size_t holder = 0;
    const auto here = [&](std::size_t n) { return bodies.piece[n].empty() ? -1 : bodies.piece[n][v]; };
    for (std::size_t n = 1; n < bodies.piece.size(); ++n)
      if (here(n) > here(holder)) holder = n;
    const calibration::Point<calibration::Patient> p_P{piece_grid_.centre_P_mm(ijk)};
    const glm::ivec3 from(glm::round(piece_grid_.indexFromPoint((X_QP[holder] * p_P).mm)));
    if (piece_grid_.contains(from) && !label_.empty() && isEnamel(label_[piece_grid_.index(from)]))
      enamel[static_cast<std::size_t>(component)] += 1.0;
  });
  std::vector<SeenPiece> seen;
  for (std::size_t n = 0; n < count; ++n) {
    seen.push_back({std::nullopt, tooth.pieces()[n].centroid_mm});
    if (enamel_voxels_ > 0.0) seen.back().enamel_share = enamel[n] / enamel_voxels_;
  }
  return pieceNames(seen, middle_P_mm_, is_whole, up_.arch);
}

WayFindings WaySearch::find(BodiesCopy& bodies, std::size_t pieces, const std::stop_token& stop) const {
  layWhereTheyAre(bodies, piece_grid_);
  const haptics::Components tooth(piece_grid_, piecesOf(bodies, piece_grid_));
  const auto count = static_cast<std::size_t>(std::ranges::count_if(
      tooth.pieces(), [](const haptics::ToothPiece& piece) { return piece.volume_mm3 >= kLooseRest_mm3; }));
  WayFindings found;
  if (count == 0) return found;
  const assets::CtVolume& ct = patient_.ct;
  std::vector<PieceWay> ways = waysOut({ct.grid, bodies.jaw, ct.label, ct.tooth}, tooth, count, up_, stop);
  if (stop.stop_requested()) return found;
  // Of those that are kept in, the one with the least in its way is the next.
  const auto first_kept = std::ranges::find_if_not(ways, [](const PieceWay& one) { return canCome(one.way); });
  std::stable_sort(first_kept, ways.end(), [](const PieceWay& a, const PieceWay& b) {
    return std::pair(a.way.answer == haptics::WayOutAnswer::not_found, a.way.in_the_way_mm3) <
           std::pair(b.way.answer == haptics::WayOutAnswer::not_found, b.way.in_the_way_mm3);
  });
  const std::vector<std::string> names = namesOf(bodies, tooth, count, pieces == 1 && !bodies.is_any_out);
  for (const PieceWay& way : ways) {
    WayOfPiece piece;
    piece.piece = names[way.piece];
    piece.answer = answerOf(way.way.answer);
    piece.waits = !found.record.pieces.empty();
    piece.kept_by_mm3 = way.way.in_the_way_mm3;
    piece.poses = way.way.poses;
    if (canCome(way.way) && up_.arch)
      piece.lift = liftInWords(firstWay(way.way, tooth.pieces()[way.piece].centroid_mm), way.way.turned_rad, *up_.arch);
    for (const InTheWay& one : way.in_the_way)
      if (piece.kept_by.size() < kMostKeepers)
        piece.kept_by.push_back({keeperName(one.words, names), one.volume_mm3, one.centre_P_mm});
    found.record.pieces.push_back(std::move(piece));
  }
  if (first_kept != ways.end()) {
    found.bone_P_mm = first_kept->bone_P_mm;
    found.voxel_mm = first_kept->voxel_mm;
  }
  return found;
}

}  // namespace app

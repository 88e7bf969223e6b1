#include "app/procedure/ways_out.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/core.h>

#include "assets/ct_volume.h"
#include "assets/tissue.h"
#include "haptics/body/piece_split.h"

namespace app {
namespace {

constexpr double kTiltToCheek = 0.45;               // of the way out
constexpr double kExit_mm = 12.0, kAside_mm = 6.0;  // how far a piece goes, and what is looked at beside its way
constexpr double kFine_mm = 0.2;                    // finer voxels are searched in twos
constexpr double kOver_mm = 2.0;                    // from the piece's middle: over it rather than beside it
constexpr double kLeastTold_mm3 = 0.05;
constexpr std::size_t kMostTold = 4;

/// A box of voxels around a piece, with all that is not the piece.
struct Scene {
  assets::VolumeGrid grid;
  std::vector<std::uint8_t> solid, piece;
  std::vector<std::size_t> scan_voxel;  ///< the most solid one of the scan, for its tissue
  std::vector<int> other_piece;         ///< -1: none
};

class Scenes {
 public:
  Scenes(const AroundTooth& around, const haptics::Components& tooth, std::size_t pieces)
      : around_(around), tooth_(tooth) {
    const glm::dvec3 offset = around.grid.indexFromPoint(tooth.grid().origin_P_mm);
    offset_ = glm::ivec3(glm::round(offset));
    for (std::size_t n = 0; n < pieces; ++n) bytes_.push_back(haptics::bytesOfPiece(tooth, n));
  }

  /// With these other pieces in their places.
  Scene of(std::size_t piece, const std::vector<std::size_t>& others, const glm::dvec3& direction) const {
    const assets::VolumeGrid& scan = around_.grid;
    glm::ivec3 low(tooth_.grid().size), high(-1);
    assets::forVoxels(tooth_.grid(), [&](glm::ivec3 ijk, std::size_t v) {
      if (bytes_[piece][v] == 0) return;
      low = glm::min(low, ijk);
      high = glm::max(high, ijk);
    });
    const int edge = scan.spacing_mm < kFine_mm ? 2 : 1;
    const glm::dvec3 way = kExit_mm * direction;
    const glm::ivec3 below(glm::ceil((kAside_mm - glm::min(way, 0.0)) / scan.spacing_mm));
    const glm::ivec3 above(glm::ceil((kAside_mm + glm::max(way, 0.0)) / scan.spacing_mm));
    const glm::ivec3 first = glm::max(low + offset_ - below, glm::ivec3(0));
    const glm::ivec3 end = glm::min(high + offset_ + above + 1, scan.size);

    Scene scene;
    scene.grid = {glm::max((end - first) / edge, glm::ivec3(1)), edge * scan.spacing_mm,
                  scan.centre_P_mm(first) + 0.5 * (edge - 1) * scan.spacing_mm};
    const std::size_t count = scene.grid.voxelCount();
    scene.solid.resize(count);
    scene.piece.resize(count);
    scene.scan_voxel.resize(count);
    scene.other_piece.assign(count, -1);
    assets::forVoxels(scene.grid,
                      [&](glm::ivec3 ijk, std::size_t v) { fill(scene, v, first + edge * ijk, edge, piece, others); });
    return scene;
  }

 private:
  /// The mean of `edge` cubed voxels of the scan.
  void fill(Scene& scene, std::size_t v, glm::ivec3 corner, int edge, std::size_t piece,
            const std::vector<std::size_t>& others) const {
    int solid = 0, of_piece = 0, most = -1;
    assets::forVoxels(corner, corner + edge, [&](glm::ivec3 at) {
      const std::size_t in_scan = around_.grid.index(at);
      int here = around_.solid[in_scan];
      const glm::ivec3 in_tooth = at - offset_;
      if (tooth_.grid().contains(in_tooth)) {
        const std::size_t t = tooth_.grid().index(in_tooth);
        of_piece += bytes_[piece][t];
        for (const std::size_t other : others) {
          if (bytes_[other][t] >= assets::kHalfSolid) scene.other_piece[v] = static_cast<int>(other);
          here = std::min(255, here + bytes_[other][t]);
        }
      }
      solid += here;
      if (here <= most) return;
      most = here;
      scene.scan_voxel[v] = in_scan;
    });
    const int voxels = edge * edge * edge;
    scene.solid[v] = static_cast<std::uint8_t>(solid / voxels);
    scene.piece[v] = static_cast<std::uint8_t>(of_piece / voxels);
    // Where both share a voxel they touch: nothing is in the way there.
    if (scene.piece[v] >= assets::kHalfSolid) scene.solid[v] = 0;
  }

  const AroundTooth& around_;
  const haptics::Components& tooth_;
  glm::ivec3 offset_{0};  ///< of the tooth's grid in the scan's
  std::vector<std::vector<std::uint8_t>> bytes_;
};

std::string keyOf(const AroundTooth& around, const Scene& scene, std::size_t v) {
  if (scene.other_piece[v] >= 0) return fmt::format("piece_{}", scene.other_piece[v]);
  const std::size_t in_scan = scene.scan_voxel[v];
  if (!around.tooth.empty() && around.tooth[in_scan] != 0) return fmt::format("tooth_{}", around.tooth[in_scan]);
  const std::uint8_t label = around.label.empty() ? std::uint8_t{0} : around.label[in_scan];
  return std::string(assets::properties(label).key);
}

/// Another tooth, or a piece of this one.
bool isNumbered(const std::string& key) { return key.starts_with("tooth_") || key.starts_with("piece_"); }

std::string nounOf(const std::string& key) {
  if (key.starts_with("tooth_")) return "tooth " + key.substr(6);
  if (key.starts_with("piece_")) return "piece " + key.substr(6);
  // The outermost solid voxels of bone may bear the label of what lies beside them.
  for (const assets::TissueProperties& tissue : assets::kTissues)
    if (tissue.key == key && tissue.tooth) return std::string(tissue.name);
  return key == "unlabelled" ? "hard tissue" : "bone";
}

/// "distobuccal", from the piece's middle.
std::string_view sideOf(const ArchFrame& arch, const glm::dvec3& from_middle_mm) {
  const double distal_mm = glm::dot(from_middle_mm, arch.distal_P), buccal_mm = glm::dot(from_middle_mm, arch.buccal_P);
  if (std::hypot(distal_mm, buccal_mm) < kOver_mm)
    return glm::dot(from_middle_mm, arch.up_P) > 0.0 ? "overlying" : "underlying";
  constexpr std::array<std::string_view, 8> kSides = {"distal", "distobuccal",  "buccal",  "mesiobuccal",
                                                      "mesial", "mesiolingual", "lingual", "distolingual"};
  const double eighth = std::atan2(buccal_mm, distal_mm) / (std::numbers::pi / 4.0);
  return kSides[static_cast<std::size_t>(std::lround(eighth) + 8) % 8];
}

void nameWhatIsInTheWay(const AroundTooth& around, const Scene& scene, const WayUp& up, const glm::dvec3& middle_P_mm,
                        PieceWay& piece) {
  std::map<std::string, InTheWay> found;
  piece.voxel_mm = scene.grid.spacing_mm;
  for (const std::size_t v : piece.way.in_the_way) {
    const glm::dvec3 p_mm = scene.grid.centre_P_mm(assets::elementAt(scene.grid.size, v));
    piece.blockers_P_mm.push_back(p_mm);
    const std::string key = keyOf(around, scene, v);
    if (!isNumbered(key)) piece.bone_P_mm.push_back(p_mm);
    std::string words = nounOf(key);
    const bool has_side = !isNumbered(key) && up.arch;
    if (has_side) words = fmt::format("{} {}", sideOf(*up.arch, p_mm - middle_P_mm), words);
    piece.in_the_way_mm3_by_label[key] += scene.grid.voxelVolume_mm3();
    InTheWay& one = found[words];
    one.words = words;
    one.volume_mm3 += scene.grid.voxelVolume_mm3();
    one.centre_P_mm += scene.grid.voxelVolume_mm3() * p_mm;
  }
  for (auto& [words, one] : found) {
    one.centre_P_mm /= one.volume_mm3;
    piece.in_the_way.push_back(one);
  }
  std::ranges::stable_sort(piece.in_the_way,
                           [](const InTheWay& a, const InTheWay& b) { return a.volume_mm3 > b.volume_mm3; });
}

}  // namespace

bool canCome(const haptics::WayOut& way) {
  return way.answer == haptics::WayOutAnswer::free || way.answer == haptics::WayOutAnswer::grazes;
}

WayUp wayUp(const assets::Patient& patient) {
  const ArchFrame arch = archFrame(patient);
  return {glm::normalize(arch.up_P + kTiltToCheek * arch.buccal_P), arch, false};
}

std::vector<PieceWay> waysOut(const AroundTooth& around, const haptics::Components& tooth, std::size_t pieces,
                              const WayUp& up, const std::stop_token& stop) {
  assert(pieces <= tooth.pieces().size() && around.solid.size() == around.grid.voxelCount());
  const Scenes scenes(around, tooth, pieces);
  const auto ask = [&](std::size_t piece, const std::vector<std::size_t>& out) {
    std::vector<std::size_t> others;
    for (std::size_t n = 0; n < pieces; ++n)
      if (n != piece && std::ranges::find(out, n) == out.end()) others.push_back(n);
    const Scene scene = scenes.of(piece, others, up.direction_P);
    PieceWay answer{piece, out, {}, {}, {}, {}, 0.0, {}};
    answer.way = haptics::findWayOut({scene.grid, scene.solid}, {scene.grid, scene.piece},
                                     {up.direction_P, kExit_mm, up.is_roomy}, stop);
    nameWhatIsInTheWay(around, scene, up, tooth.pieces()[piece].centroid_mm, answer);
    return answer;
  };

  std::vector<PieceWay> answers;
  std::vector<std::size_t> out;
  std::vector<PieceWay> held;
  for (bool has_come = true; has_come && out.size() < pieces && !stop.stop_requested();) {
    has_come = false;
    held.clear();
    for (std::size_t piece = 0; piece < pieces && !has_come && !stop.stop_requested(); ++piece) {
      if (std::ranges::find(out, piece) != out.end()) continue;
      PieceWay answer = ask(piece, out);
      has_come = canCome(answer.way);
      if (has_come) out.push_back(piece);
      (has_come ? answers : held).push_back(std::move(answer));
    }
  }
  if (out.size() < pieces) answers.insert(answers.end(), held.begin(), held.end());
  return answers;
}

std::string wordsOf(const PieceWay& piece) {
  std::string text = fmt::format("piece {}", piece.piece);
  const std::size_t before = piece.after.size();
  for (std::size_t n = 0; n < before; ++n)
    text += fmt::format("{}{}", n > 0 ? ", " : before > 1 ? ", once pieces " : ", once piece ", piece.after[n]);
  if (before > 0) text += before > 1 ? " are out" : " is out";
  switch (piece.way.answer) {
    case haptics::WayOutAnswer::free:
      return text + ": free to come out";
    case haptics::WayOutAnswer::grazes:
      return text + ": comes out tightly";
    case haptics::WayOutAnswer::not_found:
      return text + ": no way out found";
    case haptics::WayOutAnswer::blocked:
      break;
  }
  text += ": in its way";
  const char* separator = " ";
  double untold_mm3 = 0.0;
  for (std::size_t n = 0; n < piece.in_the_way.size(); ++n) {
    const InTheWay& one = piece.in_the_way[n];
    if (n >= kMostTold || one.volume_mm3 < kLeastTold_mm3) {
      untold_mm3 += one.volume_mm3;
      continue;
    }
    text += fmt::format("{}{} {:.1f} mm³", separator, one.words, one.volume_mm3);
    separator = ", ";
  }
  if (untold_mm3 >= kLeastTold_mm3) text += fmt::format(", {:.1f} mm³ elsewhere", untold_mm3);
  return text;
}

}  // namespace app

#include "app/procedure/socket/socket_check.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "assets/ct_volume.h"
#include "assets/tissue.h"
#include "haptics/body/components.h"

namespace app {
namespace {

using assets::Tissue;

constexpr std::array<glm::ivec3, 6> kFaces{glm::ivec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},
                                           {0, -1, 0},          {0, 0, 1},  {0, 0, -1}};

bool isSolid(std::uint8_t solid) { return solid >= assets::kHalfSolid; }
bool isBone(std::uint8_t label) { return assets::isHard(label) && !assets::isTooth(label); }

/// Not 0: was solid and is not any more.
std::vector<std::uint8_t> openedIn(const SiteState& site) {
  std::vector<std::uint8_t> opened(site.before.size(), 0);
  for (std::size_t v = 0; v < opened.size(); ++v)
    opened[v] = isSolid(site.before[v]) && site.jaw[v] + site.tooth[v] < assets::kHalfSolid ? 1 : 0;
  return opened;
}

std::vector<Place> retainedIn(const SiteState& site) {
  std::vector<Place> left;
  const haptics::Components tooth(site.grid, site.tooth);
  for (const haptics::ToothPiece& piece : tooth.pieces())
    if (piece.volume_mm3 >= haptics::kLeastPiece_mm3) left.push_back({piece.volume_mm3, piece.centroid_mm});
  return left;
}

void lookAtCanal(const SiteState& site, const std::vector<std::uint8_t>& opened, SocketRecord& record) {
  const assets::VolumeGrid& grid = site.grid;
  const int most = static_cast<int>(std::lround(kThroughLigament_mm / grid.spacing_mm));
  // The socket with the ligament's space, step by step from what was opened.
  std::vector<std::uint8_t> socket = opened;
  std::vector<glm::ivec3> front, next;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (opened[v] != 0) front.push_back(ijk);
  });
  for (int step = 0; step < most && !front.empty(); ++step) {
    next.clear();
    for (const glm::ivec3& ijk : front)
      for (const glm::ivec3& way : kFaces) {
        const glm::ivec3 beside = ijk + way;
        if (!grid.contains(beside)) continue;
        const std::size_t v = grid.index(beside);
        if (socket[v] != 0 || Tissue{site.label[v]} != Tissue::ligament || isSolid(site.jaw[v])) continue;
        socket[v] = 1;
        next.push_back(beside);
      }
    std::swap(front, next);
  }
  std::size_t faces = 0, by_root = 0;
  glm::dvec3 sum(0.0);
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (Tissue{site.label[v]} != Tissue::mandibular_canal) return;
    for (const glm::ivec3& way : kFaces) {
      if (!grid.contains(ijk + way)) continue;
      const std::size_t beside = grid.index(ijk + way);
      if (socket[beside] == 0) continue;
      ++faces;
      sum += grid.centre_P_mm(ijk);
      const bool is_of_tooth = assets::isTooth(site.label[beside]) || Tissue{site.label[beside]} == Tissue::ligament;
      by_root += is_of_tooth || !isSolid(site.before_jaw[beside]) ? 1 : 0;
    }
  });
  if (faces == 0) return;
  const auto n = static_cast<double>(faces);
  const double face_mm2 = grid.spacing_mm * grid.spacing_mm;
  record.canal = {n * face_mm2, sum / n};
  record.canal_by_root_mm2 = static_cast<double>(by_root) * face_mm2;
}

/// Marches from a voxel; visit(voxel number) until it answers false or the volume ends.
template <class Visit>
void march(const assets::VolumeGrid& grid, glm::ivec3 from, const glm::dvec3& way_P, double length_mm,
           const Visit& visit) {
  glm::ivec3 last = from;
  const int steps = static_cast<int>(2.0 * length_mm / grid.spacing_mm);
  for (int n = 1; n <= steps; ++n) {
    const glm::ivec3 at(glm::round(glm::dvec3(from) + 0.5 * n * way_P));
    if (at == last) continue;
    if (!grid.contains(at) || !visit(grid.index(at))) return;
    last = at;
  }
}

bool wasOutermost(const SiteState& site, glm::ivec3 ijk, const glm::dvec3& lingual_P) {
  constexpr double kBeyond_mm = 15.0;
  bool outermost = true;
  march(site.grid, ijk, lingual_P, kBeyond_mm, [&](std::size_t v) { return outermost = !isSolid(site.before[v]); });
  return outermost;
}

/// To the socket: a voxel of the tooth, or kPlate_mm without solid.
bool isThrough(const SiteState& site, glm::ivec3 ijk, const glm::dvec3& lingual_P) {
  bool through = true;
  march(site.grid, ijk, -lingual_P, kPlate_mm, [&](std::size_t v) {
    through = !isSolid(site.jaw[v]);
    return through && !assets::isToothPart(site.label[v]);
  });
  return through;
}

std::vector<Place> lingualIn(const SiteState& site, const std::vector<std::uint8_t>& opened,
                             const glm::dvec3& lingual_P) {
  const assets::VolumeGrid& grid = site.grid;
  std::vector<glm::ivec3> holes;
  assets::forVoxels(grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (opened[v] != 0 && isSolid(site.before_jaw[v]) && isBone(site.label[v]) && wasOutermost(site, ijk, lingual_P) &&
        isThrough(site, ijk, lingual_P))
      holes.push_back(ijk);
  });
  // What touches, corners included, is one hole.
  std::vector<std::uint8_t> open(grid.voxelCount(), 0);
  for (const glm::ivec3& ijk : holes) open[grid.index(ijk)] = 1;
  std::vector<Place> places;
  for (const glm::ivec3& first : holes) {
    if (std::exchange(open[grid.index(first)], std::uint8_t{0}) == 0) continue;
    std::vector<glm::ivec3> hole{first};
    std::size_t faces = 0;
    glm::dvec3 sum(0.0);
    for (std::size_t n = 0; n < hole.size(); ++n) {
      const glm::ivec3 middle = hole[n];
      assets::forVoxels(middle - 1, middle + 2, [&](glm::ivec3 beside) {
        if (grid.contains(beside) && std::exchange(open[grid.index(beside)], std::uint8_t{0}) != 0)
          hole.push_back(beside);
      });
      sum += grid.centre_P_mm(middle);
      // The face that looks to the tongue.
      constexpr double kTowards = 0.577;
      for (const glm::ivec3& way : kFaces)
        if (glm::dot(glm::dvec3(way), lingual_P) > kTowards &&
            (!grid.contains(middle + way) || !isSolid(site.before[grid.index(middle + way)])))
          ++faces;
    }
    const double area_mm2 = static_cast<double>(faces) * grid.spacing_mm * grid.spacing_mm;
    if (area_mm2 >= kLeastHole_mm2) places.push_back({area_mm2, sum / static_cast<double>(hole.size())});
  }
  std::ranges::stable_sort(places, std::greater{}, &Place::amount);
  return places;
}

}  // namespace

SocketFindings checkSocket(const SiteState& site, const SiteDirections& directions) {
  assert(site.label.size() == site.grid.voxelCount() && site.before.size() == site.label.size());
  assert(site.before_jaw.size() == site.label.size());
  assert(site.jaw.size() == site.label.size() && site.tooth.size() == site.label.size());
  const std::vector<std::uint8_t> opened = openedIn(site);
  SocketFindings found;
  found.record.retained = retainedIn(site);
  lookAtCanal(site, opened, found.record);
  found.record.lingual = lingualIn(site, opened, directions.lingual_P);
  found.edges = sharpEdges({site.grid, site.jaw, site.label, opened}, directions.up_P);
  for (const SharpEdge& edge : found.edges) found.record.edges.push_back({edge.length_mm, edge.middle_P_mm});
  for (std::vector<Place>* places : {&found.record.retained, &found.record.lingual, &found.record.edges})
    if (places->size() > kMostPlaces) places->resize(kMostPlaces);
  return found;
}

}  // namespace app

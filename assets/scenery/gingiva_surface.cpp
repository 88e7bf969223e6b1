#include "assets/scenery/gingiva_surface.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Clip.h>
#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/TopologyToLevelSet.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "assets/cut_field.h"
#include "assets/load_error.h"
#include "assets/scenery/reflected_flap.h"
#include "assets/smooth_distance.h"
#include "assets/surface_smoothing.h"
#include "assets/trilinear.h"
#include "assets/vertex_normals.h"

namespace assets {
namespace {

constexpr double kWoundReach_mm = 10.0;  // of its distances beyond the cut
constexpr double kWoundSpacing_mm = 0.5;
constexpr double kPapilla_mm = 8.0;  // height that is raised above the cut's front, at most
constexpr double kSightStep_mm = 1.0, kSight_mm = 14.0;
constexpr double kEdgeRound_mm = 1.6;
constexpr int kBandVoxels = 5;
constexpr int kSmoothingSteps = 4, kLumpSteps = 40;
constexpr double kCrumbShare = 0.01, kCrumb_mm2 = 50.0;
constexpr double kOnFlap_mm = 0.2;  // of the surface from the folded sheet

bool carriesGingiva(std::uint8_t label) { return isHard(label) || Tissue{label} == Tissue::ligament; }

// Gingiva voxels, and the bone or tooth just below them, which hides the underside.
openvdb::MaskGrid::Ptr gingivaVoxels(const CtVolume& ct) {
  constexpr int kUnder = 2;
  auto grid = openvdb::MaskGrid::create();
  auto accessor = grid->getAccessor();
  const auto label_at = [&](glm::ivec3 at) {
    return ct.grid.contains(at) ? ct.label[ct.grid.index(at)] : std::uint8_t{0};
  };
  glm::ivec3 at;
  for (at.z = 0; at.z < ct.grid.size.z; ++at.z) {
    for (at.y = 0; at.y < ct.grid.size.y; ++at.y) {
      for (at.x = 0; at.x < ct.grid.size.x; ++at.x) {
        if (label_at(at) != static_cast<std::uint8_t>(Tissue::gingiva)) continue;
        accessor.setValueOn({at.x, at.y, at.z});
        for (int axis = 0; axis < 3; ++axis) {
          for (const int step : {-1, 1}) {
            glm::ivec3 below = at;
            for (int depth = 0; depth < kUnder; ++depth) {
              below[axis] += step;
              if (!carriesGingiva(label_at(below))) break;
              accessor.setValueOn({below.x, below.y, below.z});
            }
          }
        }
      }
    }
  }
  return grid;
}

// Sets the voxels of a box to `changed(before, voxel)`, each by itself: planes in parallel, then written in order.
template <class Changed>
void changeVoxels(openvdb::FloatGrid& grid, glm::ivec3 low, glm::ivec3 high, const Changed& changed) {
  std::vector<std::vector<std::pair<openvdb::Coord, float>>> planes(static_cast<std::size_t>(high.z - low.z + 1));
  tbb::parallel_for(low.z, high.z + 1, [&](int z) {
    auto& plane = planes[static_cast<std::size_t>(z - low.z)];
    const auto accessor = grid.getConstAccessor();
    forVoxels({low.x, low.y, z}, {high.x + 1, high.y + 1, z + 1}, [&](glm::ivec3 at) {
      const openvdb::Coord voxel(at.x, at.y, at.z);
      const float before = accessor.getValue(voxel), after = changed(before, at);
      if (after != before) plane.emplace_back(voxel, after);
    });
  });
  auto accessor = grid.getAccessor();
  for (const auto& plane : planes)
    for (const auto& [voxel, after] : plane) accessor.setValue(voxel, after);
}

// Subtracts the flap from the level set. Visits every voxel near the wound, also those deep inside the gingiva.
void raiseFlap(openvdb::FloatGrid& grid, const VolumeGrid& voxels, const Wound& wound) {
  const double round = kEdgeRound_mm / voxels.spacing_mm;
  const glm::ivec3 low(glm::floor(voxels.indexFromPoint(wound.low_P_mm())));
  const glm::ivec3 high(glm::ceil(voxels.indexFromPoint(wound.high_P_mm())));
  changeVoxels(grid, low, high, [&](float before, glm::ivec3 at) {
    const double gingiva = before;
    if (gingiva >= kBandVoxels) return before;
    const double flap = -wound.distance_mm(voxels.centre_P_mm(at)) / voxels.spacing_mm;
    const double cut = smoothMax(gingiva, flap, round);
    return cut > gingiva ? static_cast<float>(std::min<double>(cut, kBandVoxels)) : before;
  });
}

// Signed distance to the gingiva around the wound, in voxels: the narrow band is thinner than the flap and is widened.
openvdb::FloatGrid::Ptr widened(const openvdb::FloatGrid& gingiva, const VolumeGrid& voxels, const Wound& wound) {
  constexpr double kMargin_mm = ReflectedFlap::kFolded_mm + 1.0;
  const glm::dvec3 low = voxels.indexFromPoint(wound.low_P_mm() - kMargin_mm);
  const glm::dvec3 high = voxels.indexFromPoint(wound.high_P_mm() + kMargin_mm);
  const openvdb::FloatGrid::Ptr near =
      openvdb::tools::clip(gingiva, openvdb::BBoxd({low.x, low.y, low.z}, {high.x, high.y, high.z}));
  const int wider = static_cast<int>(std::ceil(ReflectedFlap::kReach_mm / voxels.spacing_mm));
  return openvdb::tools::dilateSdf(*near, wider, openvdb::tools::NN_FACE, 1,
                                   openvdb::tools::FastSweepingDomain::SWEEP_GREATER_THAN_ISOVALUE);
}

// Cuts the relieving incision and adds the folded flap.
void addFlap(openvdb::FloatGrid& grid, const VolumeGrid& voxels, const Wound& wound, const ReflectedFlap& flap) {
  constexpr double kFold_mm = 0.7;  // width of its transition to the gingiva
  const glm::ivec3 low(glm::floor(voxels.indexFromPoint(wound.low_P_mm() - ReflectedFlap::kFolded_mm)));
  const glm::ivec3 high(glm::ceil(voxels.indexFromPoint(wound.high_P_mm() + ReflectedFlap::kFolded_mm)));
  const auto outside = static_cast<double>(grid.background());
  changeVoxels(grid, low, high, [&](float before, glm::ivec3 at) {
    const glm::dvec3 p_P = voxels.centre_P_mm(at);
    if (!flap.isOnCheekSide(p_P)) return before;
    double after = std::max<double>(before, -flap.incision_mm(p_P) / voxels.spacing_mm);
    const double to_flap = flap.distance_mm(p_P) / voxels.spacing_mm;
    if (to_flap < outside) after = smoothMin(after, to_flap, kFold_mm / voxels.spacing_mm);
    return static_cast<float>(std::clamp(after, -outside, outside));
  });
}

constexpr glm::vec3 kPink(0.56f, 0.205f, 0.185f);
constexpr glm::vec3 kRaw(0.40f, 0.055f, 0.045f), kPeriosteum(0.60f, 0.27f, 0.22f);

// The flap's raw underside with paler periosteum, up to the pink of its free edge.
glm::vec3 undersideAt(const glm::dvec3& p_P, double over_mm) {
  const double margin = std::clamp(1.2 + 0.8 * (over_mm - ReflectedFlap::kFolded_mm), 0.0, 1.0);
  return glm::mix(rawGumColour(p_P), kPink, static_cast<float>(0.8 * margin));
}

// Wet pink, deep red along the wound's edge and in the incision.
glm::vec3 colourAt(const glm::dvec3& p_P, const std::optional<Wound>& wound, const std::optional<ReflectedFlap>& flap) {
  const glm::vec3 pink = gumColour(p_P);
  if (!wound || !flap) return pink;
  const double over_mm = wound->distance_mm(p_P);
  const double edge = std::exp(-std::pow(std::max(0.0, over_mm) / 1.5, 2.0));
  const double incision = std::exp(-std::pow(std::max(0.0, flap->incision_mm(p_P)) / 0.45, 2.0));
  const double on_flap = std::clamp(1.0 - (flap->distance_mm(p_P) - 0.05) / 0.35, 0.0, 1.0);
  const glm::vec3 gingiva = glm::mix(pink, kWoundColour, static_cast<float>(std::max(0.85 * edge, 0.9 * incision)));
  return glm::mix(gingiva, undersideAt(p_P, over_mm), static_cast<float>(on_flap));
}

// What a rough label or the wound's edge leaves in the air is no gingiva: pieces of less than a hundredth of the
// surface and of less than a papilla's size on all sides are left out.
void takeOffCrumbs(MeshPart& part) {
  const std::vector<glm::vec3> at_mm = std::exchange(part.position_mm, {});
  const std::vector<std::uint32_t> triangles = std::exchange(part.triangles, {});
  std::vector<std::uint32_t> root(at_mm.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto root_of = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (std::size_t t = 0; t < triangles.size(); t += 3)
    for (const std::size_t other : {t + 1, t + 2}) root[root_of(triangles[t])] = root_of(triangles[other]);

  std::vector<double> area_mm2(at_mm.size(), 0.0);
  double whole_mm2 = 0.0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const glm::dvec3 a(at_mm[triangles[t]]), b(at_mm[triangles[t + 1]]), c(at_mm[triangles[t + 2]]);
    const double mm2 = 0.5 * glm::length(glm::cross(b - a, c - a));
    area_mm2[root_of(triangles[t])] += mm2;
    whole_mm2 += mm2;
  }

  const double least_mm2 = std::min(kCrumb_mm2, kCrumbShare * whole_mm2);
  constexpr std::uint32_t kNew = ~0U;
  std::vector<std::uint32_t> moved(at_mm.size(), kNew);
  for (const std::uint32_t v : triangles) {
    if (area_mm2[root_of(v)] < least_mm2) continue;
    if (moved[v] == kNew) {
      moved[v] = static_cast<std::uint32_t>(part.position_mm.size());
      part.position_mm.push_back(at_mm[v]);
    }
    part.triangles.push_back(moved[v]);
  }
}

// Two parts: the triangles with all corners on the flap are "Gum flap". Normals stay those of the whole.
template <class IsOnFlap>
MeshModel split(const MeshPart& whole, const IsOnFlap& is_on_flap) {
  std::vector<bool> on_flap;
  for (const glm::vec3& p : whole.position_mm) on_flap.push_back(is_on_flap(p));
  MeshModel model;
  model.parts.resize(2);
  for (MeshPart& part : model.parts) part.name = whole.name, part.material = whole.material;
  model.parts[1].name += " flap";
  constexpr std::uint32_t kNew = ~0u;
  std::array<std::vector<std::uint32_t>, 2> moved;
  moved.fill(std::vector<std::uint32_t>(on_flap.size(), kNew));
  for (std::size_t t = 0; t < whole.triangles.size(); t += 3) {
    const std::span corners = std::span(whole.triangles).subspan(t, 3);
    const std::size_t n = on_flap[corners[0]] && on_flap[corners[1]] && on_flap[corners[2]] ? 1 : 0;
    MeshPart& part = model.parts[n];
    for (const std::uint32_t v : corners) {
      if (moved[n][v] == kNew) {
        moved[n][v] = static_cast<std::uint32_t>(part.position_mm.size());
        part.position_mm.push_back(whole.position_mm[v]);
        part.normal.push_back(whole.normal[v]);
        part.colour.push_back(whole.colour[v]);
      }
      part.triangles.push_back(moved[n][v]);
    }
  }
  model.parts[1].material.roughness = kWetGumRoughness;
  if (model.parts[1].triangles.empty()) model.parts.pop_back();
  return model;
}

}  // namespace

glm::vec3 gumColour(const glm::dvec3& p) {
  const double speckle = 0.05 * std::sin(2.1 * p.x + 1.3 * std::sin(1.7 * p.y)) * std::sin(1.9 * p.z + p.y);
  return kPink * static_cast<float>(1.0 + speckle);
}

glm::vec3 rawGumColour(const glm::dvec3& p) {
  const double streaks = 0.5 + 0.5 * std::sin(1.3 * p.x + 2.9 * p.y + 1.8 * std::sin(1.1 * p.z + 0.6 * p.y));
  return glm::mix(kRaw, kPeriosteum, static_cast<float>(0.4 * streaks * streaks));
}

Wound::Wound(const PlannedCut& cut) {
  const CutField field(cut, kWoundReach_mm, true, kWoundSpacing_mm);
  const glm::dvec3 low = field.low_P_mm(), high = field.high_P_mm(), to_eye = kSight_mm * cut.sight_P;
  grid_.spacing_mm = kWoundSpacing_mm;
  grid_.origin_P_mm = glm::min(low, low + to_eye);
  grid_.size = glm::ivec3(glm::ceil((glm::max(high, high + to_eye) - grid_.origin_P_mm) / kWoundSpacing_mm)) + 1;
  mm_.resize(grid_.voxelCount());
  const double sight_mm = cut.sight_P == glm::dvec3(0.0) ? 0.0 : kSight_mm;
  tbb::parallel_for(0, grid_.size.z, [&](int z) {
    forVoxels(glm::ivec3(0, 0, z), glm::ivec3(grid_.size.x, grid_.size.y, z + 1), [&](glm::ivec3 ijk) {
      const glm::dvec3 p_P = grid_.centre_P_mm(ijk);
      double mm = kWoundReach_mm;
      for (double way_mm = 0.0; way_mm <= sight_mm; way_mm += kSightStep_mm)
        mm = std::min(mm, field.distance_mm(p_P - way_mm * cut.sight_P));
      mm_[grid_.index(ijk)] = static_cast<float>(mm - kFlapMargin_mm);
    });
  });
  if (cut.outward_P.z != 0.0 && !cut.strokes_P_mm.empty()) sweepUp(cut.outward_P.z, middleOf_P_mm(cut).y);
}

// Away from the bone, up in the lower jaw: the higher the farther forwards of the middle. There papillae stand over the
// cut, behind it the ramus.
void Wound::sweepUp(double up, double middle_y_P_mm) {
  const std::vector<float> below = mm_;
  forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t v) {
    const double high_mm = std::clamp(middle_y_P_mm - grid_.centre_P_mm(ijk).y, 0.0, kPapilla_mm);
    const int steps = static_cast<int>(high_mm / kWoundSpacing_mm);
    for (int n = 1; n <= steps; ++n) {
      const glm::ivec3 at(ijk.x, ijk.y, up > 0.0 ? ijk.z - n : ijk.z + n);
      if (grid_.contains(at)) mm_[v] = std::min(mm_[v], below[grid_.index(at)]);
    }
  });
}

double Wound::distance_mm(const glm::dvec3& p_P_mm) const {
  const glm::ivec3 base(glm::floor(grid_.indexFromPoint(p_P_mm)));
  if (!grid_.contains(base) || !grid_.contains(base + 1)) return kWoundReach_mm - kFlapMargin_mm;
  return trilinearAt(grid_, p_P_mm, [&](glm::ivec3 ijk) { return double{mm_[grid_.index(ijk)]}; });
}

MeshModel withFlapPart(const MeshModel& closed, const PlannedCut& cut) {
  const Wound wound(cut);
  MeshModel parts =
      split(closed.parts.front(), [&](const glm::vec3& p_P) { return wound.distance_mm(glm::dvec3(p_P)) < 0.0; });
  for (MeshPart& part : parts.parts) part.material = closed.parts.front().material;
  return parts;
}

MeshModel gingivaSurface(const CtVolume& ct, const std::optional<PlannedCut>& cut) {
  if (ct.label.size() != ct.grid.voxelCount() || !(ct.grid.spacing_mm > 0.0)) {
    throw LoadError("gingiva: labels and grid do not match, import the patient again");
  }
  const openvdb::MaskGrid::Ptr voxels = gingivaVoxels(ct);
  if (voxels->activeVoxelCount() == 0) return {};
  const openvdb::FloatGrid::Ptr surface =
      openvdb::tools::topologyToLevelSet(*voxels, kBandVoxels, 1, 0, kSmoothingSteps);
  const auto wound = cut ? std::optional<Wound>(*cut) : std::nullopt;
  std::optional<ReflectedFlap> flap;
  if (wound) {
    flap.emplace(*cut, *wound, [closed = widened(*surface, ct.grid, *wound), &ct](const glm::dvec3& p_P_mm) {
      const glm::dvec3 at = ct.grid.indexFromPoint(p_P_mm);
      return ct.grid.spacing_mm * static_cast<double>(openvdb::tools::BoxSampler::sample(
                                      closed->getConstUnsafeAccessor(), openvdb::Vec3d(at.x, at.y, at.z)));
    });
    raiseFlap(*surface, ct.grid, *wound);
    addFlap(*surface, ct.grid, *wound, *flap);
  }

  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*surface, points, triangles, quads, 0.0, 0.0);
  if (points.empty()) return {};

  // OpenVDB winds clockwise; reverse each triangle.
  MeshPart gingiva;
  gingiva.name = "Gum";
  gingiva.material = {glm::vec4(1.0f), 0.28f, 0.0f};
  for (const auto& t : triangles) gingiva.triangles.insert(gingiva.triangles.end(), {t[0], t[2], t[1]});
  for (const auto& q : quads) gingiva.triangles.insert(gingiva.triangles.end(), {q[0], q[2], q[1], q[0], q[3], q[2]});
  for (const auto& p : points) {
    const glm::dvec3 p_P = ct.grid.origin_P_mm + ct.grid.spacing_mm * glm::dvec3(p.x(), p.y(), p.z());
    gingiva.position_mm.emplace_back(p_P);
  }
  takeOffCrumbs(gingiva);
  takeOffLumps(gingiva.position_mm, gingiva.triangles, kLumpSteps);
  for (const glm::vec3& p_P : gingiva.position_mm)
    gingiva.colour.emplace_back(colourAt(glm::dvec3(p_P), wound, flap), 1.0f);
  gingiva.normal = vertexNormals(gingiva.position_mm, gingiva.triangles);
  if (!flap) return {{std::move(gingiva)}};
  return split(gingiva, [&](const glm::vec3& p_P) { return flap->distance_mm(glm::dvec3(p_P)) < kOnFlap_mm; });
}

}  // namespace assets

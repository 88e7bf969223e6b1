#include "assets/scenery/face_placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "assets/json_depth.h"
#include "assets/load_error.h"
#include "assets/toml_reader.h"
#include "assets/tooth.h"
#include "calibration/fit/rigid_fit.h"
#include "calibration/geometry/units.h"

namespace assets {
namespace {

using calibration::PointPair;
using Motion = calibration::Pose<calibration::Patient, calibration::Face>;

constexpr double kToothHeight_mm = 24.0;  ///< with root, as in the centroids of the face
constexpr double kNearTooth_mm = 9.0;
constexpr int kIterations = 40;
constexpr std::size_t kMaxPoints = 4000;
constexpr double kSiteWeight = 0.3;  ///< of the tooth at the site, often impacted
constexpr double kHold_mm = 15.0;
constexpr int kLeastNumbered = 3;

// "LR8": lower right, eighth from the midline, is FDI 48.
int fdiOf(const std::string& name) {
  if (name.size() != 3 || name[0] != 'L' || (name[1] != 'R' && name[1] != 'L')) return 0;
  if (name[2] < '1' || name[2] > '8') return 0;
  return (name[1] == 'R' ? 40 : 30) + (name[2] - '0');
}

// Voxels of the lower teeth and the normal of their occlusal plane.
struct LowerTeeth {
  std::vector<glm::dvec3> voxels_P_mm;
  glm::dvec3 up_P{0, 0, 1};
};

// A plane as a height over two axes.
struct Slope {
  double level = 0.0, along_u = 0.0, along_v = 0.0;
  double heightAt(double u, double v) const { return level + along_u * u + along_v * v; }
};

// Least squares; `points` are (u, v, height).
Slope slopeOf(const std::vector<glm::dvec3>& points) {
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& p : points) mean += p / static_cast<double>(points.size());
  glm::dmat2 normal(0.0);
  glm::dvec2 right(0.0);
  for (const glm::dvec3& p : points) {
    const glm::dvec3 d = p - mean;
    normal += glm::dmat2(d.x * d.x, d.x * d.y, d.x * d.y, d.y * d.y);
    right += d.z * glm::dvec2(d);
  }
  if (std::abs(glm::determinant(normal)) < 1e-9) return {mean.z, 0.0, 0.0};
  const glm::dvec2 slope = glm::inverse(normal) * right;
  return {mean.z - slope.x * mean.x - slope.y * mean.y, slope.x, slope.y};
}

// Besides the one at the site.
bool hasNumberedLowerTeeth(const CtVolume& ct, int site_fdi) {
  std::array<bool, 256> is_there{};
  for (const std::uint8_t fdi : ct.tooth) is_there[fdi] = true;
  int count = 0;
  for (int fdi = 1; fdi < 256; ++fdi)
    if (is_there[static_cast<std::size_t>(fdi)] && fdi != site_fdi && !isUpper(fdi)) ++count;
  return count >= kLeastNumbered;
}

// Lower teeth without the one at the site: those with numbers, as teeth without one are the upper jaw's where jaws are
// closed, or else all that are labelled. The occlusal plane is fitted to the tops of their columns, repeatedly without
// those well below it (cut roots); the teeth extend down from it.
LowerTeeth lowerTeethOf(const CtVolume& ct, int site_fdi) {
  const bool is_numbered = hasNumberedLowerTeeth(ct, site_fdi);
  const auto is_tooth = [&](glm::ivec3 at) {
    const std::size_t v = ct.grid.index(at);
    const int fdi = ct.tooth.empty() ? 0 : ct.tooth[v];
    if (fdi == 0) return !is_numbered && Tissue{ct.label[v]} == Tissue::other_teeth;
    return fdi != site_fdi && !isUpper(fdi);
  };
  std::vector<glm::ivec3> columns;
  std::vector<glm::dvec3> tops;
  for (int y = 0; y < ct.grid.size.y; ++y) {
    for (int x = 0; x < ct.grid.size.x; ++x) {
      for (int z = ct.grid.size.z - 1; z >= 0; --z) {
        if (!is_tooth({x, y, z})) continue;
        columns.emplace_back(x, y, z);
        tops.push_back(ct.grid.centre_P_mm({x, y, z}));
        break;
      }
    }
  }
  if (tops.empty()) return {};
  std::vector<glm::dvec3> kept = tops;
  Slope plane;
  for (const double below_mm : {12.0, 6.0, 4.0, 3.0, 3.0, 3.0}) {
    plane = slopeOf(kept);
    kept.clear();
    for (const glm::dvec3& p : tops) {
      if (p.z > plane.heightAt(p.x, p.y) - below_mm) kept.push_back(p);
    }
    if (kept.size() < 3) return {};
  }
  LowerTeeth teeth{{}, glm::normalize(glm::dvec3(-plane.along_u, -plane.along_v, 1.0))};
  for (const glm::ivec3& top : columns) {
    for (int z = top.z; z >= 0; --z) {
      const glm::dvec3 p = ct.grid.centre_P_mm({top.x, top.y, z});
      if (p.z < plane.heightAt(p.x, p.y) - kToothHeight_mm) break;
      if (is_tooth({top.x, top.y, z})) teeth.voxels_P_mm.push_back(p);
    }
  }
  return teeth;
}

glm::dvec3 meanOf(const std::vector<glm::dvec3>& points) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// Columns: left along the occlusal plane, its normal, and their cross product.
glm::dmat3 planeAxes(const glm::dvec3& up) {
  const glm::dvec3 left = glm::normalize(glm::dvec3(1, 0, 0) - up.x * up);
  return {left, up, glm::cross(left, up)};
}

// Vertical distance has less weight: crown heights differ between people.
double squaredDistance_mm2(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = (a - b) * glm::dvec3(1.0, 1.0, 0.3);
  return glm::dot(d, d);
}

// Pairs of centroids: of the voxels nearest to each tooth, and of the tooth; without the one at the site.
std::vector<PointPair> pairsFor(const Motion& X, const std::vector<glm::dvec3>& voxels,
                                const std::vector<FaceTooth>& teeth, int site_fdi, double voxel_mm3) {
  std::vector<glm::dvec3> sum(teeth.size(), glm::dvec3(0.0));
  std::vector<double> count(teeth.size(), 0.0);
  std::vector<glm::dvec3> placed;
  for (const FaceTooth& tooth : teeth) placed.push_back(X.rotation * tooth.open_F_mm + X.translation_mm);
  for (const glm::dvec3& p : voxels) {
    std::size_t nearest = 0;
    double best = 1e18;
    for (std::size_t n = 0; n < teeth.size(); ++n) {
      const double squared = squaredDistance_mm2(p, placed[n]);
      if (squared < best) best = squared, nearest = n;
    }
    if (teeth[nearest].fdi == site_fdi || best > kNearTooth_mm * kNearTooth_mm) continue;
    sum[nearest] += p;
    count[nearest] += 1.0;
  }
  std::vector<PointPair> pairs;
  for (std::size_t n = 0; n < teeth.size(); ++n) {
    // Ignore fragments.
    if (count[n] * voxel_mm3 < 40.0) continue;
    pairs.push_back({sum[n] / count[n], teeth[n].open_F_mm, 1.0});
  }
  return pairs;
}

double residual_mm(const Motion& X, const PointPair& pair) {
  return glm::distance(X.rotation * pair.from_mm + X.translation_mm, pair.to_mm);
}

// Normal of the plane through the face's teeth.
glm::dvec3 upOf(const std::vector<FaceTooth>& teeth) {
  std::vector<glm::dvec3> points;
  for (const FaceTooth& tooth : teeth) points.emplace_back(tooth.open_F_mm.x, tooth.open_F_mm.z, tooth.open_F_mm.y);
  const Slope plane = slopeOf(points);
  return glm::normalize(glm::dvec3(-plane.along_u, 1.0, -plane.along_v));
}

// Input of the iteration.
struct Arch {
  std::vector<glm::dvec3> voxels_P_mm;
  double voxel_mm3 = 0.0;
  glm::dvec3 up_P{0, 0, 1};
  glm::dvec3 up_F{0, 1, 0};
  std::optional<PointPair> at_site;
  int site_fdi = 0;
};

// Iterative closest point; the result has no teeth if too few agree. A second point above each tooth keeps the occlusal
// planes aligned.
FacePlacement refined(Motion X, const Arch& arch, const std::vector<FaceTooth>& teeth) {
  std::vector<PointPair> kept;
  for (int n = 0; n < kIterations; ++n) {
    kept = pairsFor(X, arch.voxels_P_mm, teeth, arch.site_fdi, arch.voxel_mm3);
    std::ranges::sort(kept, {}, [&](const PointPair& pair) { return residual_mm(X, pair); });
    kept.resize(kept.size() - kept.size() / 5);
    if (kept.size() < 3) return {};
    std::vector<PointPair> held = kept;
    if (arch.at_site) held.push_back(*arch.at_site);
    for (std::size_t i = 0, count = held.size(); i < count; ++i) {
      held.push_back({held[i].to_mm + kHold_mm * arch.up_P, held[i].from_mm + kHold_mm * arch.up_F, held[i].weight});
    }
    const auto map = calibration::rigidFit(held);
    if (!map) return {};
    X = {glm::normalize(glm::quat_cast(map->rotation)), map->translation_mm};
  }
  double squares = 0.0;
  for (const PointPair& pair : kept) squares += std::pow(residual_mm(X, pair), 2.0);
  return {X, std::sqrt(squares / static_cast<double>(kept.size())), arch.at_site ? residual_mm(X, *arch.at_site) : 0.0,
          static_cast<int>(kept.size())};
}

// Mean squared distance of the voxels to the nearest tooth, limited for far ones, plus the residual at the site.
double misfit_mm2(const FacePlacement& placement, const Arch& arch, const std::vector<FaceTooth>& teeth) {
  const Motion& X = placement.X_PF;
  double sum = 0.0;
  for (const glm::dvec3& p : arch.voxels_P_mm) {
    double best = kNearTooth_mm * kNearTooth_mm;
    for (const FaceTooth& tooth : teeth) {
      if (tooth.fdi == arch.site_fdi) continue;
      best = std::min(best, squaredDistance_mm2(p, X.rotation * tooth.open_F_mm + X.translation_mm));
    }
    sum += best;
  }
  const double at_site_mm = arch.at_site ? residual_mm(X, *arch.at_site) : 0.0;
  return sum / static_cast<double>(arch.voxels_P_mm.size()) + 0.05 * at_site_mm * at_site_mm;
}

// Within 45 degrees of upright: half an arch also fits upside down.
bool isUpright(const FacePlacement& placement) {
  const glm::dmat3 rotation_PF = glm::mat3_cast(placement.X_PF.rotation);
  return rotation_PF[0].x > 0.7 && rotation_PF[1].z > 0.5;
}

// Positions of the teeth of one quadrant (3, 4) or of both (0).
std::vector<glm::dvec3> withoutThirdMolars(const std::vector<FaceTooth>& teeth, int quadrant) {
  std::vector<glm::dvec3> out;
  for (const FaceTooth& tooth : teeth) {
    if (positionOf(tooth.fdi) != 8 && (quadrant == 0 || quadrantOf(tooth.fdi) == quadrant))
      out.push_back(tooth.open_F_mm);
  }
  return out;
}

}  // namespace

std::vector<FaceTooth> readFaceTeeth(const std::string& path) {
  constexpr std::size_t kMaxBytes = 1 << 20;
  const std::string text = readSmallFile(path, kMaxBytes, "placing a face needs the positions of its teeth");
  if (isNestedTooDeep(text)) throw LoadError(path + ": nested too deep, not a list of teeth");
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) throw LoadError(path + ": not a JSON object of teeth, check the file");

  std::vector<FaceTooth> teeth;
  for (const auto& [name, tooth] : json.items()) {
    const int fdi = fdiOf(name);
    if (fdi == 0) continue;
    const auto found = tooth.is_object() ? tooth.find("open_mean_m") : tooth.end();
    if (!tooth.is_object() || found == tooth.end() || !found->is_array() || found->size() != 3) {
      throw LoadError(path + ": tooth " + name + " lacks open_mean_m with three numbers, check the file");
    }
    glm::dvec3 open_F_mm;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const nlohmann::json& value = (*found)[axis];
      const double length_m = value.is_number() ? value.get<double>() : NAN;
      if (!(std::abs(length_m) < 1.0))
        throw LoadError(path + ": tooth " + name + " is not within a metre, give metres");
      open_F_mm[static_cast<int>(axis)] = calibration::mmFromMetres(length_m);
    }
    teeth.push_back({fdi, open_F_mm});
  }
  if (teeth.size() < 4) throw LoadError(path + ": fewer than four lower teeth (LL1..LR8), check the file");
  return teeth;
}

FacePlacement fitFace(const CtVolume& ct, const std::optional<OperativeSite>& site,
                      const std::vector<FaceTooth>& teeth) {
  if (ct.label.size() != ct.grid.voxelCount()) throw LoadError("face placement: labels and grid do not fit");
  Arch arch;
  arch.site_fdi = site ? site->fdi : 0;
  // Only if the face has that lower tooth.
  if (const auto at = std::ranges::find(teeth, arch.site_fdi, &FaceTooth::fdi); at != teeth.end())
    arch.at_site = PointPair{site->centre_P_mm, at->open_F_mm, kSiteWeight};
  LowerTeeth scanned = lowerTeethOf(ct, arch.site_fdi);
  arch.voxel_mm3 = ct.grid.voxelVolume_mm3();
  if (static_cast<double>(scanned.voxels_P_mm.size()) * arch.voxel_mm3 < 300.0) {
    throw LoadError(
        "face placement: too few other lower teeth are labelled (3), label them or rehearse without a face");
  }
  // Every n-th voxel stands for n.
  const std::size_t stride = 1 + scanned.voxels_P_mm.size() / kMaxPoints;
  for (std::size_t n = 0; n < scanned.voxels_P_mm.size(); n += stride)
    arch.voxels_P_mm.push_back(scanned.voxels_P_mm[n]);
  arch.voxel_mm3 *= static_cast<double>(stride);
  arch.up_P = scanned.up_P;
  arch.up_F = upOf(teeth);

  // The scan may show one side of the arch or both, and an impacted molar does not determine its direction: try several
  // starting poses with aligned occlusal planes and keep the best.
  const std::vector<glm::dvec3> same_side_F = withoutThirdMolars(teeth, site ? (isRight(site->fdi) ? 4 : 3) : 0);
  if (same_side_F.empty())
    throw LoadError("face placement: the face's teeth are all on the other side, add the others");
  const glm::dquat flat = glm::normalize(glm::quat_cast(planeAxes(arch.up_P) * glm::transpose(planeAxes(arch.up_F))));
  FacePlacement best;
  double best_misfit = 1e18;
  for (const std::vector<glm::dvec3>& arch_F : {withoutThirdMolars(teeth, 0), same_side_F}) {
    for (double turn_deg = -50.0; turn_deg <= 50.0; turn_deg += 10.0) {
      Motion X;
      X.rotation = glm::angleAxis(calibration::radFromDegrees(turn_deg), arch.up_P) * flat;
      X.translation_mm = meanOf(arch.voxels_P_mm) - X.rotation * meanOf(arch_F);
      const FacePlacement found = refined(X, arch, teeth);
      if (found.teeth < 3 || !isUpright(found)) continue;
      const double misfit = misfit_mm2(found, arch, teeth);
      if (misfit < best_misfit) best = found, best_misfit = misfit;
    }
  }
  if (best.teeth == 0) throw LoadError("face placement: fewer than three teeth agree, label more lower teeth");
  return best;
}

}  // namespace assets

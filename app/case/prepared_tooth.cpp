#include "app/case/prepared_tooth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "app/case/caries_lesion.h"
#include "app/case/closed_gum.h"
#include "app/case/left_out_teeth.h"
#include "app/case/treated_tooth.h"
#include "app/text/list.h"
#include "app/text/usage_error.h"
#include "assets/load_error.h"
#include "assets/tooth.h"
#include "assets/tooth_sampler.h"
#include "assets/trilinear.h"

namespace app {
namespace {

constexpr double kRowBeside_mm = 7.0, kUnderCervix_mm = 3.5, kOverTooth_mm = 1.5;
constexpr double kCrownMiddle_mm = 4.0;  ///< over the cervical line
constexpr double kSocket_mm = -1.0;      ///< over the neck: bone fills it from there down
constexpr auto kFilling = static_cast<std::uint8_t>(assets::Tissue::trabecular);
constexpr auto kNeighbourTissue = static_cast<std::uint8_t>(assets::Tissue::other_teeth);

/// The tooth's own grid, drawn out over its neighbours by whole blocks and without the ends of its roots.
assets::VolumeGrid rowGrid(const assets::VolumeGrid& tooth, const assets::ToothFrame& frame) {
  constexpr int kBlock = assets::ToothSampler::kEdge;
  const int beside = static_cast<int>(std::ceil(kRowBeside_mm / tooth.spacing_mm / kBlock)) * kBlock;
  const double up = frame.axes_P[2].z > 0.0 ? 1.0 : -1.0;
  const double low_mm = frame.cervix_P_mm.z - up * kUnderCervix_mm;
  const double end_mm = tooth.origin_P_mm.z + tooth.spacing_mm * (up > 0.0 ? tooth.size.z - 1 : 0) + up * kOverTooth_mm;
  const auto level = [&](double z_mm) {
    return static_cast<int>(std::floor((z_mm - tooth.origin_P_mm.z) / tooth.spacing_mm / kBlock)) * kBlock;
  };
  const int low = level(std::min(low_mm, end_mm)), high = level(std::max(low_mm, end_mm)) + kBlock;
  return {{tooth.size.x + 2 * beside, tooth.size.y + 2 * beside, high - low},
          tooth.spacing_mm,
          tooth.origin_P_mm + tooth.spacing_mm * glm::dvec3(-beside, -beside, low)};
}

/// In the arch.
bool isBeside(int fdi, int other) {
  const int way = assets::positionOf(other) - assets::positionOf(fdi);
  if (assets::quadrantOf(fdi) == assets::quadrantOf(other)) return way == 1 || way == -1;
  return assets::positionOf(fdi) == 1 && assets::positionOf(other) == 1 &&
         assets::isUpper(fdi) == assets::isUpper(other);
}

/// The scan beside a tooth; of other teeth the two beside it alone, as the box would cut the next ones off: bone fills
/// their sockets. Drawn over three of its voxels, whose steps would be seen and felt. Of neighbours alone, or of all
/// but the tooth itself.
class Row {
 public:
  Row(const assets::CtVolume& ct, int fdi, const assets::ToothFrame& frame, const assets::VolumeGrid& box)
      : ct_(ct), fdi_(fdi), frame_(frame) {
    const auto at = [&](glm::ivec3 ijk) {
      return glm::ivec3(glm::floor(ct.grid.indexFromPoint(box.centre_P_mm(ijk))));
    };
    const glm::ivec3 low = glm::max(at(glm::ivec3(0)) - kBeyond, glm::ivec3(0));
    const glm::ivec3 end = glm::min(at(box.size) + kBeyond + 1, ct.grid.size);
    grid_ = {glm::max(end - low, glm::ivec3(0)), ct.grid.spacing_mm, ct.grid.centre_P_mm(low)};
    neighbours_.resize(grid_.voxelCount()), all_.resize(grid_.voxelCount()), label_.resize(grid_.voxelCount());
    assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t n) { take(ijk + low, n); });
    drawOverThree(neighbours_), drawOverThree(all_);
  }

  double solid(const glm::dvec3& p_P, bool is_neighbour) const {
    const std::vector<float>& share = is_neighbour ? neighbours_ : all_;
    return assets::trilinearAt(grid_, p_P, [&](glm::ivec3 ijk) {
      return grid_.contains(ijk) ? static_cast<double>(share[grid_.index(ijk)]) : 0.0;
    });
  }
  std::uint8_t label(const glm::dvec3& p_P) const {
    const glm::ivec3 ijk(glm::floor(grid_.indexFromPoint(p_P) + 0.5));
    return grid_.contains(ijk) ? label_[grid_.index(ijk)] : std::uint8_t{0};
  }

 private:
  static constexpr int kBeyond = 2;

  void take(glm::ivec3 ijk, std::size_t n) {
    const std::size_t v = ct_.grid.index(ijk);
    const int tooth = ct_.tooth.empty() ? 0 : ct_.tooth[v];
    if (isFilled(ijk)) {
      all_[n] = 1.0F, label_[n] = kFilling;
      return;
    }
    if (tooth == fdi_ || isLeftOut(tooth)) return;
    const std::uint8_t label = ct_.label[v];
    const float share = static_cast<float>(ct_.solid[v]) / 255.0F;
    all_[n] = share, label_[n] = assets::isTooth(label) ? kNeighbourTissue : label;
    if (tooth != 0 || assets::Tissue{label} == assets::Tissue::other_teeth) neighbours_[n] = share;
  }
  bool isLeftOut(int tooth) const { return tooth != 0 && tooth != fdi_ && !isBeside(fdi_, tooth); }
  /// The socket of a tooth that is left out, with the ligament around it.
  bool isFilled(glm::ivec3 ijk) const {
    if (ct_.tooth.empty() || frame_.local(ct_.grid.centre_P_mm(ijk)).z > kSocket_mm) return false;
    const std::size_t v = ct_.grid.index(ijk);
    if (isLeftOut(ct_.tooth[v])) return true;
    if (assets::Tissue{ct_.label[v]} != assets::Tissue::ligament) return false;
    bool is_beside = false;
    assets::forVoxels(glm::max(ijk - kBeyond, glm::ivec3(0)), glm::min(ijk + kBeyond + 1, ct_.grid.size),
                      [&](glm::ivec3 at) { is_beside = is_beside || isLeftOut(ct_.tooth[ct_.grid.index(at)]); });
    return is_beside;
  }
  /// By a B-spline's weights, along each axis.
  void drawOverThree(std::vector<float>& share) const {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<float> drawn = share;
      assets::forVoxels(grid_, [&](glm::ivec3 ijk, std::size_t n) {
        glm::ivec3 low = ijk, high = ijk;
        low[axis] = std::max(0, ijk[axis] - 1), high[axis] = std::min(grid_.size[axis] - 1, ijk[axis] + 1);
        drawn[n] = (share[grid_.index(low)] + 4.0F * share[n] + share[grid_.index(high)]) / 6.0F;
      });
      share = std::move(drawn);
    }
  }

  const assets::CtVolume& ct_;
  int fdi_;
  const assets::ToothFrame& frame_;
  assets::VolumeGrid grid_;
  std::vector<float> neighbours_, all_;
  std::vector<std::uint8_t> label_;
};

}  // namespace

assets::Patient preparedTooth(const assets::Patient& whole, const std::optional<assets::JawParameters>& jaw, int fdi,
                              const Restoration& restoration, const std::string& option) {
  const FineTooth own = fineToothAlone(whole, jaw, fdi, kPreparedVoxel_mm, option, Canals::wanted);
  assets::Patient patient;
  const std::string& ideal = restoration.ideal;
  patient.title = fmt::format("{}, {} ({}), {}{}", whole.title, assets::toothName(fdi), fdi,
                              ideal == assets::kGivenIdeal ? "an ideal from a file" : ideal,
                              restoration.caries.empty() ? "" : ", caries " + restoration.caries);
  patient.prepared = assets::PreparedTooth{fdi, own.canals.frame, ideal, restoration.caries, std::nullopt};
  assets::CtVolume& ct = patient.ct;
  ct.grid = rowGrid(own.fine->grid(), own.canals.frame);
  const std::size_t count = ct.grid.voxelCount();
  ct.hounsfield.resize(count), ct.solid.resize(count), ct.label.resize(count);

  // The scan around.
  const Row row(whole.ct, fdi, own.canals.frame, ct.grid);
  const assets::VolumeGrid& tooth = own.fine->grid();
  const glm::ivec3 to_tooth(glm::round(tooth.indexFromPoint(ct.grid.origin_P_mm)));
  const auto byte = [](double share) { return static_cast<std::uint8_t>(255.0 * std::clamp(share, 0.0, 1.0) + 0.5); };
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p_P = ct.grid.centre_P_mm(ijk);
    const bool is_beside = !tooth.contains(ijk + to_tooth);
    ct.solid[v] = byte(row.solid(p_P, !is_beside));
    ct.label[v] = is_beside ? row.label(p_P) : kNeighbourTissue;
  });
  // The tooth itself, and bone between it and them.
  const auto put = [&](glm::ivec3 block, const auto& solid_of, const auto& label_of) {
    std::size_t n = 0;
    assets::forVoxels(block * assets::ToothSampler::kEdge, (block + 1) * assets::ToothSampler::kEdge,
                      [&](glm::ivec3 ijk) {
                        const std::size_t at = n++;
                        const glm::ivec3 here = ijk - to_tooth;
                        if (!ct.grid.contains(here)) return;
                        const std::size_t v = ct.grid.index(here);
                        if (ct.solid[v] > solid_of(at)) return;
                        ct.solid[v] = solid_of(at), ct.label[v] = label_of(at);
                      });
  };
  assets::forBlocks(
      *own.fine,
      [&](glm::ivec3 block, const assets::ToothSampler::Same& same) {
        put(
            block, [&](std::size_t) { return same.solid; }, [&](std::size_t) { return same.label; });
      },
      [&](glm::ivec3 block, const auto& solid, const auto& label) {
        put(
            block, [&](std::size_t n) { return solid[n]; }, [&](std::size_t n) { return label[n]; });
      });
  for (std::size_t v = 0; v < count; ++v) ct.hounsfield[v] = greyOf(ct.solid[v], ct.label[v]);

  if (!restoration.caries.empty()) {
    const auto site = cariesSiteOf(restoration.caries);
    if (!site) throw UsageError("--caries " + restoration.caries + ": no such place, give " + joined(cariesSites()));
    placeCaries(ct, own.canals.frame, *site, "--caries");
  }
  patient.classification = whole.classification;
  patient.jaw_P_mm = own.canals.frame.inP({0.0, 0.0, kCrownMiddle_mm});
  // No flap is raised for it.
  std::optional<assets::MeshModel> gum = closedGum(whole);
  patient.gingiva = gum ? *std::move(gum) : whole.gingiva;
  patient.has_modelled_gum = whole.has_modelled_gum;
  patient.face = whole.face;
  assets::MeshPart others = leftOutTeeth(whole.ct, [fdi](int other) {
    return other != fdi && !isBeside(fdi, other) && assets::isUpper(other) == assets::isUpper(fdi);
  });
  if (!others.triangles.empty()) patient.face.parts.push_back(std::move(others));
  patient.has_built_in_face = whole.has_built_in_face;
  patient.X_PF = whole.X_PF;
  return patient;
}

}  // namespace app

#include "app/psychophysics/probed_bone.h"

#include <algorithm>
#include <cmath>

#include "app/case/gutter_plan.h"
#include "app/case/patient_source.h"
#include "app/text/usage_error.h"
#include "assets/patient/patient_folder.h"
#include "assets/scan/image_file.h"
#include "assets/scan/solid_fraction.h"
#include "assets/solid_sample.h"
#include "assets/synthetic/trabecular_texture.h"

namespace app {
namespace {

constexpr double kTextureBlur_mm = 0.15, kAir_hu = -1000.0;
/// Height of the flat face within its voxel layer: f (1 - f) = 1/6, the mean softness over all orientations.
constexpr double kFaceInLayer = 0.2113248654;
constexpr double kAboveSurface_mm = 1.0, kMargin_mm = 2.0;
constexpr double kSearch_mm = 10.0, kSearchStep_mm = 0.02;

/// A box of bone under z = 0, large enough for every motion of the probe.
assets::Patient phantom(const Protocol& protocol) {
  const BoneChoice& bone = protocol.bone;
  const double R = protocol.tool.head.radius_mm, s = bone.voxel_mm;
  const double half_mm = R + 0.5 * protocol.probe.stroke_mm + 5.0 * protocol.probe.wander_mm + kMargin_mm + 2.0;
  const double depth_mm = 2.0 * protocol.probe.reach_mm + R + kMargin_mm;
  const auto voxels = [s](double mm) { return static_cast<int>(std::ceil(mm / s)); };

  assets::Patient patient;
  const bool is_flat = bone.kind == BoneChoice::Kind::flat;
  patient.title = is_flat ? "flat cortical bone" : "trabecular bone";
  assets::CtVolume& ct = patient.ct;
  ct.grid.size = {voxels(2.0 * half_mm), voxels(2.0 * half_mm), voxels(depth_mm + kAboveSurface_mm)};
  ct.grid.spacing_mm = s;
  ct.grid.origin_P_mm = {-half_mm + 0.5 * s, -half_mm + 0.5 * s, (0.5 - kFaceInLayer - voxels(depth_mm)) * s};
  ct.hounsfield.resize(ct.grid.voxelCount());
  ct.label.assign(ct.grid.voxelCount(), 0);
  ct.solid.assign(ct.grid.voxelCount(), 0);
  const assets::TrabecularTexture texture(bone.seed, kTextureBlur_mm);
  const auto label = static_cast<std::uint8_t>(is_flat ? assets::Tissue::cortical : assets::Tissue::trabecular);
  for (int k = 0; k < ct.grid.size.z; ++k)
    for (int j = 0; j < ct.grid.size.y; ++j)
      for (int i = 0; i < ct.grid.size.x; ++i) {
        const glm::dvec3 p = ct.grid.centre_P_mm({i, j, k});
        const std::size_t voxel = ct.grid.index({i, j, k});
        // Exact share of the voxel below the face, so flat bone is as flat as voxels allow.
        const double under = std::clamp(0.5 - p.z / s, 0.0, 1.0);
        const double hu = is_flat ? assets::properties(label).hounsfield : texture.hounsfield(p);
        ct.hounsfield[voxel] = static_cast<std::int16_t>(std::lround(std::lerp(kAir_hu, hu, under)));
        if (under > 0.0) ct.label[voxel] = label;
        ct.solid[voxel] = static_cast<std::uint8_t>(std::lround(255.0 * under));
      }
  if (!is_flat) ct.solid = assets::classify(ct.grid, ct.hounsfield, patient.classification);
  return patient;
}

assets::Patient volumeOf(const BoneChoice& bone) {
  assets::Patient patient;
  patient.title = "volume";
  assets::CtVolume& ct = patient.ct;
  if (bone.is_hounsfield) {
    assets::HounsfieldImage image = assets::readHounsfield(bone.path);
    ct.grid = image.grid;
    ct.hounsfield = std::move(image.hounsfield);
    ct.solid = assets::classify(ct.grid, ct.hounsfield, patient.classification);
  } else {
    assets::ByteImage image = assets::readSolid(bone.path);
    ct.grid = image.grid;
    ct.solid = std::move(image.values);
    ct.hounsfield.assign(ct.solid.size(), assets::kAirHu);
  }
  ct.label.assign(ct.solid.size(), 0);
  return patient;
}

/// First surface on the line through the site from outside: trilinear, half solid.
ProbeSite onSurface(const assets::CtVolume& ct, const ProbeSite& site) {
  for (double above = kSearch_mm; above >= -kSearch_mm; above -= kSearchStep_mm) {
    const glm::dvec3 p = site.surface_P.mm + above * site.outward_P.xyz;
    if (assets::solidAt(ct, p) >= 0.5) return {{p}, site.outward_P};
  }
  throw UsageError("bone.site_P_mm: there is no bone within 10 mm of it along outward_P, move the site to the bone");
}

}  // namespace

ProbedBone probedBone(const Protocol& protocol) {
  const BoneChoice& bone = protocol.bone;
  switch (bone.kind) {
    case BoneChoice::Kind::flat:
    case BoneChoice::Kind::trabecular:
      return {phantom(protocol), {}};
    case BoneChoice::Kind::volume: {
      assets::Patient patient = volumeOf(bone);
      const ProbeSite site = onSurface(patient.ct, *bone.site);
      return {std::move(patient), site};
    }
    case BoneChoice::Kind::patient:
      break;
  }
  assets::Patient patient = bone.path.empty() ? builtInPatient({}) : assets::loadPatient(bone.path);
  ProbeSite site;
  if (bone.site) {
    site = *bone.site;
  } else {
    const auto trough = planGutter(patient, protocol.tool.head.radius_mm);
    if (!trough)
      throw UsageError("bone.patient: no tooth at work with bone beside it, say bone.site_P_mm and bone.outward_P");
    site = {{trough->surface_P_mm}, {trough->outward_P}};
  }
  site = onSurface(patient.ct, site);
  return {std::move(patient), site};
}

}  // namespace app

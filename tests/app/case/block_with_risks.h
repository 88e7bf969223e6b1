// A right jaw as a block of bone with straight sides: third molar buried in it, numbered second molar in front, canal
// below; its lingual side is a plane. For distances by closed form.
#pragma once

#include <cmath>

#include "assets/patient.h"

namespace app::test {

inline constexpr double kPlate_x_mm = -10.0, kCrest_z_mm = 0.0, kCanalAxis_z_mm = -20.0, kCanalTube_mm = 1.7;

inline assets::Patient blockWithRisks() {
  using assets::Tissue;
  assets::Patient patient;
  patient.title = "a block";
  assets::CtVolume& ct = patient.ct;
  ct.grid = {{84, 96, 72}, 0.5, {-38.0, 16.0, -28.0}};
  ct.hounsfield.assign(ct.grid.voxelCount(), -1000);
  ct.solid.assign(ct.grid.voxelCount(), 0);
  ct.label.assign(ct.grid.voxelCount(), 0);
  ct.tooth.assign(ct.grid.voxelCount(), 0);
  patient.site = {48, {-20.0, 40.0, -9.0}, {0.0, 0.0, 1.0}};
  patient.mandibular_canal_P_mm = {{-20.0, 16.0, kCanalAxis_z_mm}, {-20.0, 63.0, kCanalAxis_z_mm}};
  patient.mandibular_canal_radius_mm = kCanalTube_mm;
  assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
    const bool molar = std::hypot(p.x + 20.0, p.y - 40.0) < 5.0 && p.z < -2.0 && p.z > -17.0;
    const bool second = std::hypot(p.x + 20.0, p.y - 28.0) < 5.2 && p.z < 4.0 && p.z > -14.0;
    const bool canal = std::hypot(p.x + 20.0, p.z - kCanalAxis_z_mm) < kCanalTube_mm;
    if (!molar && !second && (p.z > kCrest_z_mm || p.x > kPlate_x_mm || p.x < -30.0)) return;
    ct.tooth[v] = molar ? 48 : second ? 47 : 0;
    ct.label[v] = static_cast<std::uint8_t>(canal             ? Tissue::mandibular_canal
                                            : molar || second ? Tissue::dentine
                                                              : Tissue::cortical);
    ct.hounsfield[v] = canal ? 40 : 1500;
    ct.solid[v] = canal ? 0 : 255;
  });
  return patient;
}

}  // namespace app::test

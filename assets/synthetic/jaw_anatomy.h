// The whole synthetic jaw as nested signed distances, tissue by tissue, at any point.
// Frame J (dental_arch.h), mm, negative inside. Immutable; any thread reads. A query costs 0.1-1 us, less where
// `NearbyStructures` says that structures are out of reach. No grey values here (scanner.h), no voxels (jaw.h).
// Periodontal ligament 0.25 mm, follicle 0.8 mm round the crown, lamina dura 0.45 mm (textbook means).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "assets/synthetic/mandible_shape.h"
#include "assets/synthetic/mandibular_canal_path.h"
#include "assets/synthetic/tooth_row.h"

namespace assets {

/// Distances at a point; a structure out of reach stays at kFar_mm.
struct TissueDistances {
  static constexpr double kFar_mm = 1e3;
  double third_molar = kFar_mm;       ///< outer surface
  double third_molar_core = kFar_mm;  ///< dentine with pulp
  double third_molar_pulp = kFar_mm;
  double other_tooth = kFar_mm;
  int other_position = 0;  ///< from the midline, of the nearest other tooth
  double other_core = kFar_mm;
  double other_pulp = kFar_mm;
  double ligament = kFar_mm;          ///< ligaments and follicle, teeth included
  double mandibular_canal = kFar_mm;  ///< lumen
  double trabecular = kFar_mm;
  double bone = kFar_mm;     ///< outer surface, sockets not subtracted
  double gingiva = kFar_mm;  ///< gingiva, bone included
};

/// What can matter within a ball; found once per brick.
struct NearbyStructures {
  bool any = false;
  bool mandibular_canal = false;
  std::uint32_t teeth = 0;  ///< bit n: tooth n of the row
};

struct AnatomyParameters {
  double winter_angle_deg = 45.0;
  double depth_mm = 3.0;
  double mandibular_canal_distance_mm = 2.0;
  std::uint64_t seed = 1;
};

class JawAnatomy {
 public:
  /// Throws LoadError when the third molar, the canal at that distance and the bone can not be had together.
  explicit JawAnatomy(const AnatomyParameters& parameters);

  NearbyStructures nearby(const glm::dvec3& centre_J, double radius_mm) const;
  TissueDistances at(const glm::dvec3& p_J, const NearbyStructures& nearby) const;

  const PlacedTooth& thirdMolar() const { return teeth_.back(); }
  const std::vector<PlacedTooth>& teeth() const { return teeth_; }
  const MandibularCanalPath& mandibularCanal() const { return *mandibular_canal_; }
  const DentalArch& arch() const { return arch_; }

 private:
  void placeMandibularCanal(double distance_mm);

  DentalArch arch_;
  MandibleShape mandible_;
  std::vector<PlacedTooth> teeth_;  ///< erupted ones, the third molar last
  std::optional<MandibularCanalPath> mandibular_canal_;
};

}  // namespace assets

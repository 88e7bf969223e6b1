// The synthetic jaw as nested signed distances, tissue by tissue. Frame J (dental_arch.h), mm, negative inside.
// Immutable; any thread. A query takes 0.1-1 us, less where NearbyStructures excludes structures. Periodontal ligament
// 0.25 mm, follicle 0.8 mm around the crown, lamina dura 0.45 mm (textbook means).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "assets/synthetic/jaw.h"
#include "assets/synthetic/mandible_shape.h"
#include "assets/synthetic/mandibular_canal_path.h"
#include "assets/synthetic/tooth_row.h"

namespace assets {

/// Distances of one tooth, or of the nearest of several.
struct ToothDistances {
  double outer = 1e3, core = 1e3, pulp = 1e3;  ///< core: dentine with pulp
};

/// Distances at a point; kFar_mm for structures out of reach.
struct TissueDistances {
  static constexpr double kFar_mm = 1e3;
  ToothDistances third_molar, other_tooth;
  int other_position = 0;             ///< of the nearest other tooth, from the midline
  double ligament = kFar_mm;          ///< ligaments and follicle, teeth included
  double mandibular_canal = kFar_mm;  ///< lumen
  double trabecular = kFar_mm;
  double bone = kFar_mm;     ///< outer surface, sockets not subtracted
  double gingiva = kFar_mm;  ///< bone included
};

/// Structures within reach of a ball, determined once per brick.
struct NearbyStructures {
  bool any = false;
  bool mandibular_canal = false;
  MandibularCanalPath::Stretch canal_stretch;  ///< nearest to the ball
  std::uint32_t teeth = 0;                     ///< bit n: tooth n of the row
};

/// The arch coordinates of a vertical line, determined once where a point on it asks for them.
using ArchLine = std::optional<ArchCoordinates>;

class JawAnatomy {
 public:
  /// Throws LoadError if third molar, canal distance and bone are not compatible.
  explicit JawAnatomy(const JawParameters& parameters);

  NearbyStructures nearby(const glm::dvec3& centre_J, double radius_mm) const;
  /// `line`: of the points straight above and below; at first none.
  TissueDistances at(const glm::dvec3& p_J, const NearbyStructures& nearby, ArchLine& line) const;
  TissueDistances at(const glm::dvec3& p_J, const NearbyStructures& nearby) const {
    ArchLine line;
    return at(p_J, nearby, line);
  }

  const PlacedTooth& thirdMolar() const { return teeth_.back(); }
  const MandibularCanalPath& mandibularCanal() const { return *mandibular_canal_; }

 private:
  void placeMandibularCanal(double distance_mm);

  DentalArch arch_;
  MandibleShape mandible_;
  std::vector<PlacedTooth> teeth_;  ///< erupted ones, the third molar last
  std::optional<MandibularCanalPath> mandibular_canal_;
};

}  // namespace assets

// A view of the solid bodies a tool can meet: the jaw at rest in P, pieces of tooth with a pose each, a filling. Their
// solid fractions add up where they share a voxel. All have voxels of one size. One field alone converts to it. The
// bones must outlive the view. Trivially copyable; mm.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <span>

#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"
#include "haptics/bone/solid_field.h"

namespace haptics {

inline constexpr std::size_t kMaxPieces = 4;  ///< of the tooth
inline constexpr std::size_t kMaxBodies = 1 + kMaxPieces;
inline constexpr std::size_t kMaxMet = kMaxBodies + 1;  ///< and a filling

struct SolidBody {
  SolidField field;
  bool at_rest = true;  ///< the pose is the identity, and is not applied
  calibration::Pose<calibration::Patient, calibration::Piece> X_PQ;

  calibration::Point<calibration::Patient> inBody(const calibration::Point<calibration::Patient>& p_P) const {
    return at_rest ? p_P : calibration::Point<calibration::Patient>{(X_PQ.inverse() * p_P).mm};
  }
  /// The tool as the field sees it: for functions of a field at rest in P.
  calibration::Pose<calibration::Patient, calibration::Tool> inBody(
      const calibration::Pose<calibration::Patient, calibration::Tool>& X_PT) const {
    if (at_rest) return X_PT;
    const calibration::Pose<calibration::Piece, calibration::Tool> X_QT = X_PQ.inverse() * X_PT;
    return {X_QT.rotation, X_QT.translation_mm};
  }
  calibration::Vector<calibration::Patient> fromBody(const calibration::Vector<calibration::Patient>& v) const {
    return at_rest ? v : calibration::Vector<calibration::Patient>{X_PQ.rotation * v.xyz};
  }
};

class SolidBodies {
 public:
  /// One field at rest.
  SolidBodies(const SolidField& field) { add({field, true, {}}); }  // NOLINT(google-explicit-constructor)

  void add(const SolidBody& body) {
    assert(count_ < kMaxMet);
    bodies_[count_++] = body;
  }

  std::span<const SolidBody> bodies() const { return {bodies_.data(), count_}; }
  double spacing_mm() const { return bodies_[0].field.grid.spacing_mm; }
  bool isLabelled() const { return bodies_[0].field.label != nullptr; }

 private:
  std::array<SolidBody, kMaxMet> bodies_{};
  std::size_t count_ = 0;
};

}  // namespace haptics

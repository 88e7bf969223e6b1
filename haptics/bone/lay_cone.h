// A cone that is let go of in a root canal becomes filling: the gutta-percha of round cones from node to node, flat at
// the tip, up to the plane where it is seared off, and around it the sealer that it brought, at most `coat_mm` thick,
// from the tip on until it is used up; both only into air. They count as one material. From its links one after the
// other, kBlocksPerTick blocks a tick, so that the work of a tick is bounded: under 60 us; some 0.3 s a cone. Frame P,
// mm. The thread that owns the filling; no allocation, no throw.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "haptics/bone/filling.h"

namespace haptics {

/// Sealer around a cone as it goes in. Our default: what stays of a thin coat.
inline constexpr double kSealerCoat_mm = 0.1;

struct LaidCone {
  static constexpr std::size_t kMostNodes = 33;

  std::size_t nodes = 0;  ///< from the end that is held to the tip
  std::array<glm::dvec3, kMostNodes> node_P_mm{};
  std::array<double, kMostNodes> radius_mm{};
  double coat_mm = kSealerCoat_mm, sealer_mm3 = 0.0;
  glm::dvec3 seared_P_mm{0.0}, out_P{0.0, 0.0, 1.0};  ///< nothing is laid beyond that plane
};

/// Part of the servo's state.
class ConeLaying {
 public:
  static constexpr int kBlocksPerTick = 12, kLookedAtPerTick = 400;

  void begin(const LaidCone& cone, unsigned increment) noexcept;
  /// What is laid stays; the rest is lost.
  void stop() noexcept { link_ = 0; }
  bool isRunning() const noexcept { return link_ != 0; }
  /// A tick of it. Returns the steps of 1/255 of a voxel laid.
  std::int64_t step(const SolidField& tooth, Filling& filling, StrokeHistory* strokes) noexcept;

 private:
  struct Cover {
    double core, all;  ///< 0..1 of a voxel: of the cone, and of the cone with its sealer
  };
  Cover coverAt(const glm::dvec3& p_P_mm, double spacing_mm) const noexcept;
  double distance_mm(const glm::dvec3& p_P_mm, std::size_t link) const noexcept;
  bool layBlock(const SolidField& tooth, Filling& filling, glm::ivec3 block, std::int64_t& laid,
                StrokeHistory* strokes) noexcept;
  void openLink(const Filling& filling) noexcept;

  LaidCone cone_;
  std::size_t link_ = 0;  ///< that is laid now, from the tip's down to 1; 0: none
  unsigned increment_ = 0;
  glm::ivec3 first_{0}, size_{0};  ///< blocks around it
  std::size_t next_ = 0;           ///< of them
  double sealer_left_mm3_ = 0.0;
};

}  // namespace haptics

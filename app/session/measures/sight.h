// How much was removed out of sight (reference/product 4.3: S7), and what the mirror was good for (4.4: M10): the share
// of what was removed at places from which no ray reached either eye at that moment, straight or by the mirror; the
// share that an eye saw in the mirror; how long an eye saw the working end there. What hides: sight_lines.h, bone and
// teeth as they then were. Frame P, mm, s. A pure function; any thread; 5 µs a voxel, 15 with a mirror: of more than
// kMostLookedAt every second, third … one is looked at.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/session/eyes_event.h"
#include "app/session/measures/removal_clock.h"
#include "app/session/second_hand_event.h"
#include "assets/soft_tissue_field.h"

namespace app {

/// From this moment on.
struct EyesFrom {
  double t_s = 0.0;
  EyesPlace eyes;
};
struct HeldFrom {
  double t_s = 0.0;
  bool assistant_holds = false, flap_aside = false;
};

/// Of the instrument in the hand.
struct WorkingEnd {
  double t_s = 0.0, dt_s = 0.0;  ///< for how long it counts
  glm::dvec3 at_P_mm{0.0};
};

struct SeenWork {
  std::span<const std::uint8_t> before, after;   ///< solid, in the order of the clock's grid
  const assets::SoftTissueField& soft_tissue;    ///< may be empty
  std::span<const EyesFrom> eyes;                ///< by time, the first holds from the beginning; not empty
  std::span<const HeldFrom> held;                ///< by time; empty: nothing was held
  std::span<const std::uint8_t> is_tooth = {};   ///< not 0 in the tooth that hides nothing any more from out_s on
  std::optional<double> out_s = {};              ///< none: it never was out
  const SecondHandTrack* second_hand = nullptr;  ///< none: no mirror
  std::span<const WorkingEnd> ends = {};         ///< by time
};

struct SightOfWork {
  std::optional<double> hidden;     ///< share of removal, 0 to 1; none: nothing was removed by a bur
  std::optional<double> in_mirror;  ///< the same
  double mirror_view_s = 0.0;
};

inline constexpr std::size_t kMostLookedAt = 20'000;

SightOfWork sightOfWork(const RemovalClock& clock, const SeenWork& work);

}  // namespace app

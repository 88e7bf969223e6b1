// How much was removed out of sight (reference/product 4.3: S7): the share of what was removed at places from which no
// ray reached either eye at that moment. What hides: bone and teeth at least half solid, the surface that is drawn, as
// they then were; lip, cheek, tongue and gum unless they were held aside. The bur hides nothing. Frame P, mm, s. A pure
// function; any thread; 5 µs a voxel: of more than kMostLookedAt every second, third … one is looked at.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/session/eyes_event.h"
#include "app/session/measures/removal_clock.h"
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

struct SeenWork {
  std::span<const std::uint8_t> before, after;  ///< solid, in the order of the clock's grid
  const assets::SoftTissueField& soft_tissue;   ///< may be empty
  std::span<const EyesFrom> eyes;               ///< by time, the first holds from the beginning; not empty
  std::span<const HeldFrom> held;               ///< by time; empty: nothing was held
  std::span<const std::uint8_t> is_tooth = {};  ///< not 0 in the tooth that hides nothing any more from out_s on
  std::optional<double> out_s = {};             ///< none: it never was out
};

inline constexpr std::size_t kMostLookedAt = 20'000;

/// 0 to 1; none: nothing was removed by a bur.
std::optional<double> shareOutOfSight(const RemovalClock& clock, const SeenWork& work);

}  // namespace app

// How the access is drilled, tick by tick: how deep the bur's end is below the cusp, and how the chamber's roof was
// gone through - force before, way and speed after it gave way, how far the bur fell below (reference/sisters 4). Frame
// P; mm, N, s. Any one thread; a hundred ns a tick.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "app/procedure/root_canal/access_outcomes.h"
#include "assets/ct_volume.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

struct RoofDrop {
  double t_s = 0.0;
  double force_N = 0.0;         ///< largest of the 100 ms before
  double speed_mm_per_s = 0.0;  ///< into the tooth, over the 50 ms after
  double plunge_mm = 0.0;       ///< of the bur's end below the roof within a quarter of a second
};
/// "the roof of the chamber is open: 1.8 N before, then 14 mm/s, 1.2 mm below it".
std::string roofDropText(const RoofDrop& drop);

/// Lower molars have the bands of depthBand(); of other teeth nothing is told.
bool hasDepthBands(int fdi);

class AccessWatch {
 public:
  /// `is_open`: there is no roof to go through.
  explicit AccessWatch(const assets::ToothCanals& tooth, bool is_open = false)
      : tooth_(tooth), pulp_(tooth), is_open_(is_open) {}

  /// The drop, once, a quarter of a second after it began.
  std::optional<RoofDrop> follow(const haptics::Tick& tick, const haptics::Tool& tool);
  /// Of the bur's end while it turns within the crown; none: elsewhere, or another tool.
  const std::optional<double>& belowCusp_mm() const { return below_mm_; }

 private:
  struct Past {
    double t_s, force_N;
  };

  const assets::ToothCanals& tooth_;
  assets::PulpDistance pulp_;
  bool is_open_;
  std::optional<double> below_mm_;
  std::deque<Past> past_;  ///< of 100 ms
  std::optional<RoofDrop> falling_;
  glm::dvec3 broke_P_mm_{0.0};
  std::optional<double> after_mm_;  ///< way of the first 50 ms
};

}  // namespace app

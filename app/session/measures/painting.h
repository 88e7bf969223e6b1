// Whether a bur paints the bone away or plunges into it (reference/product 4.4): the painting index, 0 to 1, the
// geometric mean of five shares, so that one bad part shows,
//   sweep     of the time in contact, with 3 mm/s or more along the surface
//   shallow   of the strokes, no deeper than a quarter of the bur's radius
//   straight  the median of chord over length of strokes longer than 1 mm
//   overlap   of the strokes, beside the one before by a quarter to one radius
//   light     1 / (1 + CV) of the force along the normal: even pressure
// and the plunge ratio, way into the bone over way along it. Over drilling in contact where the bone's surface is near.
// N, mm, s. A stream: one thread.
#pragma once

#include <optional>
#include <vector>

#include "app/session/measures/strokes.h"

namespace app {

struct PaintingParts {
  /// None: there was too little to tell.
  std::optional<double> sweep, shallow, straight, overlap, light, plunge_ratio;

  /// 0 where a part is 0, none where one is not known.
  std::optional<double> index() const;
};

class PaintingIndex {
 public:
  void add(const WorkSample& sample);
  void add(const Stroke& stroke);
  PaintingParts parts() const;

 private:
  double contact_s_ = 0.0, sweep_s_ = 0.0, into_mm_ = 0.0, along_mm_ = 0.0;
  double force_sum_Ns_ = 0.0, force_squares_N2s_ = 0.0;
  std::optional<Stroke> last_;
  std::size_t strokes_ = 0, shallow_ = 0, neighbours_ = 0, overlapping_ = 0;
  std::vector<double> straightness_;  ///< of strokes longer than 1 mm
};

/// None: of no values.
std::optional<double> medianOf(std::vector<double> values);

}  // namespace app

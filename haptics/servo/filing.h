// A bone file at work: what it takes away while it is pressed on bone and drawn along it,
//   dV/dt = kFiling_mm3_per_s · min(1, F/kFilingForce_N) · min(1, v/kFilingSpeed_mm_per_s),
// v along the surface, from all bone that its head covers alike; teeth and soft tissue nothing. Never more than the
// head has covered (bone/carve). 200 mm3/min: reference/extraction 9; force and speed at which it is reached are our
// defaults. The feed is that of the proxy, not of the hand. Frame P; mm, N, s. Servo thread; the cost of bone/carve.
#pragma once

#include "haptics/body/bodies.h"
#include "haptics/bone/stroke_history.h"
#include "haptics/contact/contact.h"

namespace haptics {

inline constexpr double kFiling_mm3_per_s = 200.0 / 60.0, kFilingForce_N = 3.0, kFilingSpeed_mm_per_s = 10.0;

class Filing {
 public:
  struct Engagement {
    calibration::Pose<calibration::Patient, calibration::Tool> X_PT;  ///< at the proxy
    BurShape head;
    Contact contact;
    calibration::Vector<calibration::Patient> force_P_N;
  };
  /// Nothing with `allowed` false. Changed blocks are saved to `strokes`.
  CarveResult file(Bodies& bodies, StrokeHistory& strokes, const Engagement& engaged, bool allowed, double dt_s,
                   std::uint64_t tick) noexcept;

 private:
  calibration::Point<calibration::Patient> last_P_;
  bool was_on_bone_ = false;
};

}  // namespace haptics

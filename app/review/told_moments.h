// The moments of a rehearsal that its report shows: where an event happened that no average hides, where the turning
// bur came nearest to what it had to keep off, the first error, touch and warning of each kind. Pure; any thread.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/review/bone_pictures.h"
#include "app/review/session_course.h"
#include "app/session/metrics.h"

namespace app {

struct ToldMoment {
  double t_s = 0.0;
  std::string what;  ///< of several within kSameMoment_s all, in the order of their weight
};

inline constexpr std::size_t kMostTold = 8;  ///< the lighter ones are left out
inline constexpr double kSameMoment_s = 0.2;

/// In order of time.
std::vector<ToldMoment> toldMoments(const SessionMetrics& metrics, const SessionCourse& course);

/// With the force of the model then, seen from several sides.
struct MomentPicture {
  ToldMoment moment;
  double force_N = 0.0;
  std::vector<BonePicture> views;
};
/// The number, from 0, of the picture of this moment; none: it is not shown.
std::optional<std::size_t> pictureOf(std::span<const MomentPicture> pictures, double t_s);

}  // namespace app

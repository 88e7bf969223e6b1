// Where the instrument of the second hand was drawn, as an event of a recording: whenever it was drawn elsewhere than
// in the frame before, to the last bit, and when it was lost. It is seen and not felt, so the servo knows nothing of
// it: like the eyes, and unlike the hand, it is no part of a tick. Frame P, mm. Pure; any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/instrument/second_instrument.h"
#include "calibration/geometry/frames.h"
#include "calibration/geometry/pose.h"

namespace app {

/// Kind of these events.
inline constexpr char kSecondHandEvent[] = "second hand pose";
/// Kind of the event that names it, at the start; alone in recordings from before poses were kept.
inline constexpr char kSecondHandNamed[] = "second hand";

struct SecondHandPlace {
  assets::SecondInstrument instrument = assets::SecondInstrument::mirror;
  bool is_tracked = false;  ///< false: lost, not drawn
  calibration::Pose<calibration::Patient, calibration::OtherTool> X_PO;
};

/// The same instrument at the same place, to the last bit.
bool isSamePlace(const SecondHandPlace& a, const SecondHandPlace& b);

/// One line of JSON.
std::string secondHandText(const SecondHandPlace& place);
/// None of other words, an unknown instrument, or numbers that are no pose.
std::optional<SecondHandPlace> secondHandFrom(const std::string& text);

/// Its places over time, as read from events in order.
class SecondHandTrack {
 public:
  void add(double t_s, const SecondHandPlace& place) { places_.push_back({t_s, place}); }
  bool isEmpty() const { return places_.empty(); }
  /// The last one that had begun; none before the first, and while it was lost. O(log n).
  std::optional<SecondHandPlace> at(double t_s) const;

 private:
  struct From {
    double t_s = 0.0;
    SecondHandPlace place;
  };
  std::vector<From> places_;  ///< by time
};

}  // namespace app

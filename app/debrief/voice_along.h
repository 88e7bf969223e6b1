// A session's voice, beside its picture while that plays forwards at the speed of life: which samples the sound card is
// to be given, so that what is heard is what was said at the tick that is shown, within 40 ms. The card's own clock may
// drift and positions may jump: then it begins anew there. Pure but for reading segments; one thread; 5 ms where a
// segment begins.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "app/evaluation/voice/voice_track.h"

namespace app {

class VoiceAlong {
 public:
  /// `rate_Hz`: of the card.
  VoiceAlong(VoiceTrack track, double tick_s, double rate_Hz);

  struct Piece {
    bool begins = false;         ///< what was handed on before is not played any more
    std::vector<float> samples;  ///< to be handed on
  };
  /// `waiting`: samples that were handed on since the newest that began, and were not played yet.
  Piece next(double position_s, bool plays_along, std::size_t waiting);
  /// Of a hand that drags: kGrain_s from a new position on, faded in and out; nothing where it rests.
  Piece grain(double position_s);
  static constexpr double kGrain_s = 0.08;

 private:
  std::vector<float> samplesFrom(double& at, std::size_t count);

  VoiceTrack track_;
  double tick_s_, rate_Hz_, step_;  ///< samples of the track in one of the card
  double next_ = 0.0;               ///< of the track
  bool is_on_ = false;
  std::optional<double> grain_s_;  ///< of the newest grain
};

}  // namespace app

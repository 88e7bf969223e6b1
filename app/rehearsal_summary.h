// What a rehearsal came to, as one screen of text with units. Carries the case's title, never a person's data. Pure.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "app/motion_to_photon.h"
#include "app/session/recorder.h"
#include "assets/tissue.h"
#include "haptics/loop/loop_statistics.h"
#include "haptics/safety/trips.h"

namespace app {

struct RehearsalFigures {
  std::string patient_title;
  std::string bur;  ///< as people type it
  SessionCalibration calibration;
  double duration_s = 0.0;
  std::array<double, assets::kTissueCount> removed_mm3{};
  std::uint64_t frames = 0;
  double frame_ms = 0.0;                                ///< mean time between pictures
  std::string display, quality;                         ///< in words, at the end
  std::optional<PhotonEstimate> latency, slow_latency;  ///< median and 95th percentile; none without a window
  double first_picture_s = 0.0;  ///< from the user's asking to the first picture, loading included
  haptics::LoopFigures servo;
  haptics::TripLedger trips;
  double rate_Hz = 1000.0;
  std::optional<RecordingSummary> recording;
};

/// "real-time priority, core 3, memory locked".
std::string grantsText(const haptics::RealtimeGrants& grants);

/// "60031 ticks, 11 deadlines missed, 0 by its own work; late by 32 µs, 99 % below 66, at most 4254; real-time …".
std::string punctualityText(const haptics::LoopFigures& servo);

std::string summaryText(const RehearsalFigures& figures);

}  // namespace app

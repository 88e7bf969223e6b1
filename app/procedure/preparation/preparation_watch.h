// What a tooth preparation has come to while it goes on: P1 to P9 of a copy of the live tooth, on a thread of its own,
// a moment after each stroke. The ideal is made by the first measurement (some seconds). Main thread, once a frame;
// microseconds. Frame P.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/procedure/preparation/preparation_outcomes.h"
#include "app/procedure/preparation/preparation_paint.h"
#include "app/procedure/tooth_copy.h"
#include "assets/prepared_tooth.h"

namespace app {

class PreparationWatch {
 public:
  /// Borrows the bodies. `before`: of the scan's grid, before anything was cut. Throws UsageError: no such ideal.
  PreparationWatch(const assets::PreparedTooth& tooth, const assets::CtVolume& scan,
                   std::span<const std::uint8_t> before, const haptics::Bodies& bodies);
  ~PreparationWatch();

  /// `bricks`: changed since the last call. True: newest() is new.
  bool follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest);
  /// None: nothing was measured yet.
  const std::optional<PreparationOutcomes>& newest() const { return newest_; }
  /// Of the newest outcomes; empty where there are none.
  const PreparationPaint& paint() const { return paint_; }
  /// Waits: all of the tooth as it is, for a picture of it. False: it cannot be measured.
  bool measureNow();
  /// For the surgeon: "34 of 118 mm³ cut, 0.4 too much; walls 14°, margin 0.9 mm"; why the tooth cannot be measured;
  /// empty: nothing was measured.
  const std::string& line() const { return line_; }

 private:
  struct Copy;
  struct Measured {
    std::optional<PreparationOutcomes> outcomes;
    PreparationPaint paint;
    std::string refusal;
  };

  void take(Measured measured);

  std::unique_ptr<Copy> copy_;  ///< the worker reads it
  const haptics::Bodies& bodies_;
  std::vector<glm::ivec3> changed_;
  std::future<Measured> measuring_;
  StrokePause pause_;
  std::optional<PreparationOutcomes> newest_;
  PreparationPaint paint_;
  std::string line_;
};

std::string preparationLine(const PreparationOutcomes& outcomes);
/// "12.1 mm³ laid, 83 % of the cavity filled, 100 % cured; overhang 0.31 mm³, 0.2 mm".
std::string fillingLine(const FillingOutcomes& filling);

}  // namespace app

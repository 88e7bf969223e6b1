// What a root canal treatment has come to while it goes on: TreatmentMeter of a copy of the tooth that is
// brought up to date by bricks, on a thread of its own, a moment after each stroke and every ten seconds of a long one.
// Main thread, once a frame; microseconds. The worker takes a second of CPU time at the start, then a fifth. Frame P.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/procedure/root_canal/treatment.h"
#include "app/procedure/tooth_copy.h"
#include "assets/ct_volume.h"
#include "haptics/body/bodies.h"

namespace app {

class TreatmentWatch {
 public:
  /// Borrows all. `before`: of the tooth's grid, before anything was cut.
  TreatmentWatch(const assets::ToothCanals& tooth, const assets::CtVolume& scan, std::span<const std::uint8_t> before,
                 const haptics::Bodies& bodies);
  ~TreatmentWatch();

  /// `bricks`: changed since the last call. True: newest() is new.
  bool follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, const FileUse& files);
  /// None: nothing was measured yet.
  const std::optional<Treatment>& newest() const { return newest_; }
  /// How often it was measured, and the longest of it, CPU time.
  int times() const { return times_; }
  double longest_s() const { return longest_s_; }

 private:
  struct Copy;
  struct Measured {
    std::optional<Treatment> treatment;  ///< none: of the whole tooth, only so that it is known
    double took_s = 0.0;
  };

  std::unique_ptr<Copy> copy_;  ///< the worker reads it
  const haptics::Bodies& bodies_;
  std::vector<glm::ivec3> changed_;
  std::future<Measured> measuring_;
  StrokePause pause_;
  double longest_s_ = 0.0;
  int times_ = 0;
  std::optional<Treatment> newest_;
};

/// For the surgeon: "distal: 0.42 mm³, 61 % of its wall untouched, least dentine 0.92 mm; roof 83 % open". Canals that
/// nothing was taken of are left out; empty: nothing was cut.
std::string treatmentLine(const Treatment& treatment);

}  // namespace app

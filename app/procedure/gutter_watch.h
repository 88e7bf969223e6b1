// How far the planned gutter is done while bone is removed: the share of its bone that is gone, and the share of the
// crown it lays bare that is bare (case/enamel_exposure). Keeps a copy of the volume, brings it up to date by bricks
// and counts on a thread of its own, once a second of the rehearsal at most. Main thread, once a frame; microseconds,
// but for a servo that is stepped it waits for the count (some ms). Frame P.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "assets/patient.h"
#include "assets/planned_cut.h"
#include "haptics/body/bodies.h"

namespace app {

class GutterWatch {
 public:
  struct Shares {
    double gutter_removed = 0.0, crown_bared = 0.0;  ///< 0..1; 1 where the plan has nothing to do
  };

  /// Borrows all. `before`: the jaw as scanned, in the order of its grid.
  GutterWatch(const assets::Patient& patient, std::span<const std::uint8_t> before, const assets::PlannedCut& cut,
              const haptics::Bodies& bodies);
  ~GutterWatch();

  /// `bricks`: of the jaw's grid, changed since the last call.
  void follow(std::span<const glm::ivec3> bricks, double t_s, bool waits);
  /// None: not counted yet.
  const std::optional<Shares>& newest() const { return newest_; }

 private:
  struct Copy;

  std::unique_ptr<Copy> copy_;  ///< the count that runs reads it
  const haptics::Bodies& bodies_;
  std::vector<glm::ivec3> changed_;
  std::future<Shares> counting_;
  std::optional<double> counted_s_;
  std::optional<Shares> newest_;
};

}  // namespace app

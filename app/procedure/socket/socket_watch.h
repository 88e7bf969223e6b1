// Looks at the socket (socket_check) from the moment the first piece of tooth is out: on a thread of its own, when bone
// or pieces have changed, once a second of the rehearsal at most. Keeps a copy of the jaw, brought up to date by
// bricks. Main thread, once a frame; a look costs it 10 ms for copies, and where the servo is stepped it waits for the
// result. Frame P.
#pragma once

#include <array>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/procedure/socket/socket_check.h"
#include "assets/patient.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/tick.h"

namespace app {

/// Of an operated tooth; the patient must have a site.
SiteDirections siteDirections(const assets::Patient& patient);

class SocketWatch {
 public:
  /// Borrows patient and bodies; the patient's voxels are labelled and it has a site. `before`: the jaw as scanned, in
  /// the order of its grid.
  SocketWatch(const assets::Patient& patient, std::span<const std::uint8_t> before, const haptics::Bodies& bodies);
  ~SocketWatch();
  SocketWatch(const SocketWatch&) = delete;
  SocketWatch& operator=(const SocketWatch&) = delete;

  /// `bricks`: of the jaw's grid, changed since the last call.
  void follow(std::span<const glm::ivec3> bricks, const haptics::Tick& newest, bool waits);
  /// The last look; none: no piece is out.
  const std::optional<SocketFindings>& newest() const { return newest_; }
  /// Looks once more, at all that has changed, with the servo stopped.
  const std::optional<SocketFindings>& finish(std::span<const glm::ivec3> bricks, const haptics::Tick& newest);

 private:
  struct Copy;

  void look(const haptics::Tick& newest);

  std::unique_ptr<Copy> copy_;  ///< the look that runs reads it
  const haptics::Bodies& bodies_;
  std::vector<glm::ivec3> changed_;
  std::array<bool, haptics::kMaxPieces> was_out_{};
  std::size_t pieces_ = 0;
  std::optional<double> looked_s_;
  std::future<SocketFindings> looking_;
  std::optional<SocketFindings> newest_;
};

}  // namespace app

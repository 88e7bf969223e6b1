// What becomes of the tooth while it is sectioned, in words for the surgeon: how thick the bridge is that still holds
// it, and into which pieces it has come apart. Looks on a thread of its own (procedure/teeth_watch); main thread.
// Nothing it finds enters the servo. Without a tooth of its own (haptics/body/bodies) it says nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "app/procedure/teeth_watch.h"
#include "haptics/body/bodies.h"

namespace app {

/// "in 2 pieces, 412 and 324 mm³", "held by a bridge of 14.0 mm², 1.9 mm thick"; empty: whole.
std::string toothText(const haptics::ToothFindings& findings);

class ToothFollower {
 public:
  /// Borrows the bodies. `whole`: the tooth before the first cut, in the order of its grid; empty: as it is.
  explicit ToothFollower(haptics::Bodies& bodies, std::span<const std::uint8_t> whole = {});

  /// Bricks of the jaw's grid that have changed. `bone_digest`: Tick::bone_digest of the newest tick.
  void follow(std::span<const glm::ivec3> bricks, std::uint64_t bone_digest);
  /// A line when the bridge has become thinner than 3, 2 or 1 mm, or a piece has come apart.
  std::optional<std::string> news();
  /// With the servo stopped: all of the tooth, looked at once more, as toothText().
  std::string ending();

 private:
  void giveAll(std::uint64_t bone_digest);

  haptics::Bodies& bodies_;
  std::unique_ptr<TeethWatch> watch_;  ///< null: no tooth
  std::uint64_t looks_ = 0;
  std::size_t pieces_told_ = 1;
  int bridge_told_mm_ = 4;  ///< the limit told last
};

}  // namespace app

// Bricks changed since the last call of takeInto(), one atomic bit each: brick (x, y, z) is bit n = (z ny + y) nx + x,
// in word n / 64. The writer marks after storing voxels (release); one reader takes and clears (acquire), then copies.
// mark(): wait-free. takeInto(): O(bricks / 64). No allocation after construction.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

namespace haptics {

class DirtyBricks {
 public:
  explicit DirtyBricks(glm::ivec3 bricks);

  void mark(glm::ivec3 brick);
  /// Appends the dirty bricks to `out` and clears them. Reader only.
  void takeInto(std::vector<glm::ivec3>& out);

 private:
  glm::ivec3 bricks_;
  std::size_t words_;
  std::unique_ptr<std::atomic<std::uint64_t>[]> bits_;
};

}  // namespace haptics

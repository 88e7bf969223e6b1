// The sections of one canal that its measures read, each computed once: what it was before is kept for good, what it is
// until a block near its walls changes. Frame P, mm. One thread; a section costs 0.4 ms of CPU time at first, 0.1 ms
// when it has changed.
#pragma once

#include <map>
#include <span>

#include "app/procedure/root_canal/canal_section.h"

namespace app {

class CanalSections {
 public:
  /// Borrows the fields and the canal.
  CanalSections(const ToothBlocks& before, const FineSolid& after, const assets::ToothCanal& canal,
                const glm::dvec3& furcation_P)
      : before_(before), after_(after), canal_(canal), furcation_P_(furcation_P) {}

  const CanalSection& at(double from_foramen_mm);
  const assets::ToothCanal& canal() const { return canal_; }

  /// Blocks of `after` that have changed. False: no section that was asked for reads any of them.
  bool forget(std::span<const glm::ivec3> blocks);

 private:
  struct Kept {
    CanalSection section;
    bool is_known = true;  ///< as it is now
  };

  const ToothBlocks& before_;
  const FineSolid& after_;
  const assets::ToothCanal& canal_;
  glm::dvec3 furcation_P_;
  std::map<double, Kept> kept_;
};

}  // namespace app

// The marks of the instrument on soft tissue, for the picture, from every tick in order: the way of a turning bur's
// head through soft tissue, which stays, and the places pressed, which redden within half a second and fade within
// about two. A function of the ticks and the heads alone, so that a replay draws the same at the same time. Soft tissue
// does not heal: undo puts bone back, no cut. At most render::kMostSoftCuts cuts: beyond that the one that is best
// covered by another gives way. Frame P; mm, s. Main thread; below a microsecond a tick, some tens where the list is
// full.
#pragma once

#include <optional>
#include <span>

#include "haptics/servo/tick.h"
#include "haptics/tool/bur_shape.h"
#include "render/soft_marks.h"

namespace app {

class SoftMarkTrail {
 public:
  /// `ticks` in order, made with this head.
  void follow(std::span<const haptics::Tick> ticks, const haptics::BurShape& head);
  const render::SoftMarks& marks() const { return marks_; }

 private:
  void cut(const haptics::Tick& tick, const haptics::BurShape& head);
  void add(const render::SoftCut& cut);
  void redden(const haptics::Tick& tick);

  render::SoftMarks marks_;
  std::optional<render::SoftCut> last_;  ///< the head where it cut last; none: it is out of soft tissue
};

}  // namespace app

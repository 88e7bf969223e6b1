// What lies loose at the site of a recorded session, and what the soft tissue shows of the work, for any moment: chips,
// follicle, stitches, cuts and red places, followed as in the rehearsal, at 50 looks a second instead of its frames,
// and kept a few times a second where they changed. Sharp edges are not: DebriefRun looks for them.
// Frame P. Any one thread; a microsecond a tick; at most kMost pictures of some kB.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "app/debrief/film.h"
#include "app/rehearsal/loose_site.h"
#include "app/rehearsal/soft_mark_trail.h"
#include "assets/patient.h"
#include "assets/soft_tissue_field.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"

namespace app {

class SiteFilm {
 public:
  static constexpr std::size_t kMost = 1200;
  static constexpr double kBetweenLooks_s = 0.02;

  /// Before the first tick; borrows bodies and soft tissue. `down_P`: as the patient lay.
  SiteFilm(const assets::Patient& patient, const haptics::Bodies& bodies, const assets::SoftTissueField& soft_tissue,
           const glm::dvec3& down_P);

  /// Every tick in order, made with this command.
  void follow(const haptics::Tick& tick, const haptics::Command& command);
  bool looks(double t_s) const { return t_s >= next_look_s_; }
  /// When looks(): the bricks of the jaw's grid that have changed since the last call.
  void look(const haptics::Tick& tick, std::span<const glm::ivec3> bricks);
  /// As it was at a moment that has been followed; adds to the beads of the frame.
  void show(double t_s, render::Frame& frame) const;

 private:
  struct Shown {
    std::vector<render::Bead> beads;
    render::SoftMarks marks;
  };

  LooseSite loose_;
  SoftMarkTrail soft_marks_;
  std::uint64_t loosened_ = 0;  ///< serial of the newest order for chips that was done
  double next_look_s_ = 0.0;
  Film<Shown> film_{kMost, 0.1};
};

}  // namespace app

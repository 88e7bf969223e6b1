// What lies loose or is sewn at the site, followed in the rehearsal and of a recording alike: chips and follicle that
// come loose and are taken, stitches once a piece of the tooth is out; and how it is drawn. A function of ticks,
// commands and bricks. Frame P. Any one thread; a microsecond a tick.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "app/procedure/closure/stitches.h"
#include "app/procedure/debris/follicle.h"
#include "app/procedure/debris/loose_chips.h"
#include "assets/patient.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"
#include "render/frame.h"

namespace app {

/// A point of a sharp edge, as it is drawn.
inline render::Bead edgeMark(const glm::dvec3& p_P_mm) { return {{p_P_mm}, 0.18, render::BeadKind::mark}; }

class LooseSite {
 public:
  /// Borrows bodies and soft tissue. `down_P`: unit, along gravity as the patient lies.
  LooseSite(const assets::Patient& patient, const haptics::Bodies& bodies, const assets::SoftTissueField& soft_tissue,
            const glm::dvec3& down_P);

  /// Every tick in order, made with this command. True: it made a stitch.
  bool follow(const haptics::Tick& tick, const haptics::Command& command);
  /// Some times a second: bricks of the jaw's grid that have changed since the last call.
  void followBone(std::span<const glm::ivec3> bricks, const haptics::Tick& newest);
  /// Chips that have just left the volumes.
  void loosen(const haptics::ChipPlan& plan, const haptics::Tick& tick) { chips_.add(plan, tick); }

  const LooseChips& chips() const { return chips_; }
  const Follicle& follicle() const { return follicle_; }
  const Stitches& stitches() const { return stitches_; }
  /// Chips and follicle; once a piece is out stitches and the places for them.
  std::vector<render::Bead> beads() const;

 private:
  LooseChips chips_;
  Follicle follicle_;
  Stitches stitches_;
  std::ptrdiff_t out_ = 0;  ///< pieces, when the bone was followed last
};

}  // namespace app

// Bites on articulating paper while a rehearsal goes on: the live tooth is copied when the jaws close and measured on a
// thread of its own, a second at the first bite, half of one after that. Main thread, once a frame; the copy some
// 20 ms. Frame P.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "app/procedure/preparation/bite.h"
#include "app/session/bite_event.h"
#include "assets/ct_volume.h"
#include "assets/prepared_tooth.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/tick.h"

namespace app {

/// A tooth and what opposes it, bitten on as often as wanted.
class BittenTooth {
 public:
  struct Marked {
    Bite bite;
    PaintSpots spots;        ///< of the marks
    assets::VolumeGrid box;  ///< of the spots
  };

  /// `crown`: of that tooth, before anything was cut.
  BittenTooth(Crown crown, const assets::PreparedTooth& tooth);

  Marked bitten(const BoxBytes& made, double paper_mm) const;
  const assets::VolumeGrid& box() const { return crown_.solid.grid(); }

 private:
  Crown crown_;
  Antagonist antagonist_;
};

/// `t_s`: after the last tick whose tooth it is.
BiteRecord recordOf(const Bite& bite, double t_s);

class BiteWatch {
 public:
  /// Borrows all. `before`: of the scan's grid, before anything was cut.
  BiteWatch(const assets::PreparedTooth& tooth, const assets::CtVolume& scan, std::span<const std::uint8_t> before,
            const haptics::Bodies& bodies, double paper_mm);
  ~BiteWatch();

  /// What keeps the jaws from closing; empty: they close. `waits`: it is marked when this returns.
  std::string close(const haptics::Tick& newest, bool waits);
  /// True: marked() is new.
  bool follow();
  const std::optional<BittenTooth::Marked>& marked() const { return marked_; }
  /// Of the newest marks.
  const BiteRecord& record() const { return record_; }

 private:
  struct Copy;
  void take();

  std::unique_ptr<Copy> copy_;  ///< the worker reads it
  const haptics::Bodies& bodies_;
  double paper_mm_, closed_at_s_ = 0.0;
  std::future<BittenTooth::Marked> marking_;
  bool is_new_ = false;
  std::optional<BittenTooth::Marked> marked_;
  BiteRecord record_;
};

}  // namespace app

// What a root-canal file does, from every tick: how deep it is and in which canal, in words for the surgeon's line;
// what breaks, bends or passes the foramen, told as it happens and recorded; and the summary. Lengths as the rubber
// stop shows them: from the canal's reference on the crown along the handle. Main thread, once a frame; microseconds a
// tick.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/procedure/root_canal/treatment.h"
#include "app/session/fragment_trail.h"
#include "assets/tooth_canals.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

inline constexpr const char* kFileEvent = "canal file";
/// Of the access cavity (root_canal/access_watch).
inline constexpr const char* kAccessEvent = "access cavity";

class CanalLog {
 public:
  /// `before`: what files had left in the tooth.
  explicit CanalLog(const assets::ToothCanals& tooth, haptics::WearLaw wear = haptics::WearLaw::wear,
                    const std::vector<assets::MetalFragment>& before = {});

  /// What happened, in order.
  std::vector<std::string> follow(std::span<const haptics::Tick> ticks, const haptics::Tool& tool);

  const FileUse& use() const { return use_; }
  /// What broken files have left in the tooth, if that has changed since the last call.
  std::optional<std::span<const assets::MetalFragment>> takeFragments();

  /// "17.2 of 20.4 mm in the distal canal, watch-winding, torque 34 %, 0.12 mm³"; "free" outside.
  std::string line(const haptics::Tick& tick) const;
  /// "distal canal: to size 25 at 20.3 of 20.4 mm; 0.42 mm³ filed"; empty: nothing was filed.
  std::string summary() const;

 private:
  double depth_mm(const haptics::Tick& tick, const assets::ToothCanal& canal) const;

  FileUse use_;
  haptics::WearLaw wear_;
  FragmentTrail fragments_;
  bool fragments_changed_ = false;
  bool is_cone_ = false;       ///< in the hand
  bool is_cone_long_ = false;  ///< beyond the foramen: told when it begins
  double cone_mm3_ = 0.0;      ///< laid so far of one that was let go of
};

}  // namespace app

// What the operation has left (O1 to O11), as it grows, tick by tick: for rules that ask for it while it is done. Those
// that are sums over voxels (O1, O2, O3, O10) are of every tick; those that look at the whole cut (O4 to O9, O11) of
// every kBetween_s of ticks, counted from the first, and stand until then. A function of bone, ticks and commands
// alone: the same whoever runs the servo. Where a value is of the last tick, it is that of outcome.h. Frame P, mm, mm3.
// One thread, that of the servo step; the blocks of voxels that the tick has written, and for the whole cut some 10 ms.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/session/measures/original_surface.h"
#include "app/session/measures/removal_clock.h"
#include "app/session/measures/session_case.h"
#include "app/session/measures/zones.h"
#include "app/session/session_start.h"
#include "haptics/body/bodies.h"
#include "haptics/servo/command.h"
#include "haptics/servo/tick.h"

namespace app {

class BoneMeasures {
 public:
  static constexpr double kBetween_s = 0.5;

  /// Borrows start and case; `bodies` as they are before the first tick. `ids` of outcomeNames(). A pass over the
  /// voxels where the plan is asked for, and the surface of the bone where the floor of the trough is.
  BoneMeasures(const StoredStart& start, const SessionCase& about, const haptics::Bodies& bodies,
               std::vector<std::string> ids);

  /// After each tick, with the bodies that it left; takes what they have written (CarvedBone::takeWritten).
  void add(const haptics::Tick& tick, const haptics::Command& in_force, haptics::Bodies& bodies);

  const std::vector<std::string>& ids() const { return ids_; }
  /// In their order; none: it cannot be told of this case, or not yet.
  std::span<const std::optional<double>> values() const { return values_; }

 private:
  static constexpr std::size_t kVoxels = 64;
  /// Of 4x4x4 voxels of the jaw's grid that something went of.
  struct Touched {
    glm::ivec3 first{0};
    std::array<double, kVoxels> from_plan_mm{}, planned{};
    std::array<std::optional<double>, kVoxels> t_s{};  ///< when a bur first took some of it
  };
  struct Bones;

  bool asks(std::string_view beginning) const;
  void collect(haptics::Bodies& bodies, bool anew, std::optional<double> cut_s);
  void follow(const Bones& bones, glm::ivec3 block, std::optional<double> cut_s);
  Touched& touchedAt(glm::ivec3 block);
  void addChange(const Touched& touched, std::size_t within, glm::ivec3 ijk, std::size_t v, std::uint8_t now);
  void tellSums(const haptics::Tick& tick);
  void tellWhole(const haptics::Tick& tick, const haptics::Bodies& bodies);
  void tell(std::string_view id, std::optional<double> value);

  const StoredStart& start_;
  const SessionCase& about_;
  std::vector<std::string> ids_, whole_ids_;  ///< all; of the whole cut
  std::vector<std::optional<double>> values_;
  bool asks_plan_;
  std::optional<OriginalSurface> surface_;
  std::optional<Zones> zones_;
  std::vector<std::uint8_t> after_;  ///< in the order of the grid
  std::vector<std::int32_t> place_;  ///< in touched_, by block; -1: nothing went of it
  glm::ivec3 blocks_{0};
  std::vector<Touched> touched_;
  std::vector<std::size_t> written_;
  std::uint64_t every_ = 1;  ///< ticks
  std::optional<std::uint64_t> digest_;
  std::array<bool, haptics::kMaxPieces> aside_{};
  bool is_changed_ = true;  ///< since the whole cut was looked at
  std::uint8_t pieces_ = 0;
  std::optional<double> parted_s_;
  // Sums: voxels, but for the planned mm3.
  double bone_ = 0.0, both_ = 0.0, second_molar_ = 0.0, planned_mm3_ = 0.0;
  std::array<double, kZones> by_zone_{};
  bool has_second_molar_ = false;
};

}  // namespace app

// What a whole root-canal treatment has come to: access, every canal, what broke and where the files went; with its
// gates: perforation, a separated file, a foramen that was moved. From the tooth before and after and the files' ticks.
// Frame P, mm. Pure; any thread; some 0.5 s a molar.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/procedure/root_canal/access_outcomes.h"
#include "app/procedure/root_canal/canal_outcomes.h"
#include "app/procedure/root_canal/file_motion.h"
#include "app/procedure/root_canal/perforation.h"
#include "app/procedure/root_canal/placed_fragment.h"
#include "app/procedure/root_canal/root_filling.h"
#include "haptics/file/canal_wear.h"
#include "haptics/servo/tick.h"

namespace app {

/// Flutes count as full.
inline constexpr double kFlutesFull = 0.99;

/// For people and for files: "rate", "counters", "counters-helical".
std::string_view nameOf(haptics::WearLaw law);

/// A foramen whose wall moved farther was transported (reference/sisters 2.3, our default).
inline constexpr double kForamenMoved_mm = 0.1;

/// What files did, from every tick in order.
class FileUse {
 public:
  explicit FileUse(const assets::ToothCanals& tooth);
  /// `size`: of the file in the hand; 0: none, or a cone. Ticks in order, without gaps in the hand.
  void add(const haptics::Tick& tick, int size);
  /// What lies in the tooth now, whole (session/fragment_trail, fragments_event).
  void setFragments(std::span<const assets::MetalFragment> lying) { lying_ = placed(tooth_, lying); }

  const assets::ToothCanals& tooth() const { return tooth_; }
  const TipTrack& tip(std::size_t canal) const { return canals_[canal].tip; }
  /// The thickest that came within a millimetre of the working length.
  int size(std::size_t canal) const { return canals_[canal].size; }
  double torque_share() const { return torque_share_; }
  double filed_mm3() const { return filed_mm3_; }
  int broken() const { return broken_; }
  /// In the tooth now; an undo takes them back.
  int fragments() const { return fragments_; }
  const std::vector<PlacedFragment>& lying() const { return lying_; }
  /// Chips that are not out of the canals.
  double debris_mm3() const { return debris_mm3_; }
  /// Of the file in the hand, and how long any filed with full ones.
  bool isFull() const { return is_full_; }
  double full_s() const { return full_s_; }
  int bent() const { return bent_; }
  double filing_s() const { return filing_s_; }
  const MotionNames& motion() const { return motion_; }

 private:
  struct Canal {
    TipTrack tip;
    int size = 0;
  };
  void moveOn(const haptics::Tick& tick, int size);

  assets::ToothCanals tooth_;
  std::vector<Canal> canals_;
  std::vector<PlacedFragment> lying_;
  double torque_share_ = 0.0, filed_mm3_ = 0.0, filing_s_ = 0.0;
  double debris_mm3_ = 0.0, full_s_ = 0.0;
  int broken_ = 0, bent_ = 0, fragments_ = 0;
  bool is_full_ = false;
  int in_hand_ = 0;
  bool is_bent_ = false;  ///< the one in the hand: told once
  MotionNames motion_;
  glm::dvec3 last_handle_P_mm_{0.0};
  double in_mm_ = 0.0;  ///< way of the handle towards the tip
};

struct TreatedCanal {
  std::string name;
  CanalOutcomes outcomes;
  std::optional<LengthError> length;  ///< none: no file was in it
  StraightLine straight_line;
  int size = 0;
  std::optional<RootFilling> filling;  ///< none: nothing was laid in it
};

struct Treatment {
  std::vector<TreatedCanal> canals;
  LostTissue lost;
  RoofOutcome roof;
  OutlineOutcome outline;
  std::vector<Perforation> perforations;
  int broken_files = 0, bent_files = 0;
  int fragments_left = 0;                 ///< in the tooth at the end, of all its sessions
  std::vector<PlacedFragment> fragments;  ///< they
  double torque_share = 0.0, filed_mm3 = 0.0, filing_s = 0.0;
  double debris_left_mm3 = 0.0;                 ///< chips that are not out of the canals
  double full_s = 0.0;                          ///< against the wall with full flutes
  std::array<double, kFileMotions> motion_s{};  ///< of filing_s; the rest was held still or had no name

  bool isForamenMoved() const;
  /// What files did, canals apart.
  void setFiles(const FileUse& files);
};

/// "filing 62 %, watch-winding 25 %" of the time against the wall, the longest first; empty: none.
std::string motionWords(const Treatment& treatment);

/// `laid`: into it; null: nothing.
Treatment treatmentOf(const assets::ToothCanals& tooth, const ToothBlocks& before, const FineSolid& after,
                      const FileUse& files, const FineSolid* laid = nullptr);

}  // namespace app

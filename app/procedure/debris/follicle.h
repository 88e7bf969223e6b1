// The follicle around the crown, as blobs of some 4 mm3 that stick to the socket: label ligament within some 2 mm of
// the enamel and farther than 0.5 mm from the root, gathered in cells. A curette that is pressed with more than 0.5 N
// and drawn along the wall scrapes the blobs off that its tip comes near; suction or forceps take the loose ones, a
// turning bur tears them to nothing. One that no bone or tooth is beside any more holds on to nothing: it is loose.
// Soft tissue does not grow again: an undo brings none back. A function of ticks and tools alone. Frame P, mm. Main
// thread; a microsecond a tick while a curette works. Rules: reference/extraction 9; the law has no friction, so the
// pull along the wall is told by pressure and motion. Our defaults are named below.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/procedure/debris/suction_tip.h"
#include "assets/patient.h"
#include "haptics/servo/tick.h"
#include "haptics/tool/tool.h"

namespace app {

inline constexpr double kScrapeReach_mm = 1.0, kScrape_N = 0.5;
inline constexpr double kScraped_mm = 2.0;  ///< way along the wall that loosens a blob; our default
inline constexpr double kHolds_mm = 0.5;    ///< from its ball to what it sticks to; our default
inline constexpr double kForcepsReach_mm = 3.0;
inline constexpr std::size_t kMostBlobs = 40;

struct FollicleBlob {
  enum class State : std::uint8_t { stuck, loose, taken };
  glm::dvec3 at_P_mm{0.0};
  double volume_mm3 = 0.0, radius_mm = 0.0;  ///< of a ball of that volume
  glm::dvec3 outward_P{0.0};                 ///< unit, away from the crown; 0: none
  double stuck = 1.0;                        ///< share
  State state = State::stuck;
};

/// None without a site, or where nothing is labelled so.
std::vector<FollicleBlob> follicleOf(const assets::Patient& patient);

class Follicle {
 public:
  explicit Follicle(std::vector<FollicleBlob> blobs) : blobs_(std::move(blobs)) {}

  /// Every tick, in order, made with this tool. `tip`: of a suction; none: another tool.
  void follow(const haptics::Tick& tick, const haptics::Tool& tool, const std::optional<SuctionTip>& tip);

  /// After bone or tooth has gone. is_bare(place, mm): nothing solid is nearer.
  using IsBare = std::function<bool(const glm::dvec3& p_P_mm, double within_mm)>;
  void letLoose(const IsBare& is_bare);

  const std::vector<FollicleBlob>& blobs() const { return blobs_; }
  /// Share of its volume that is not taken; none: there is none.
  std::optional<double> left() const;

 private:
  void scrape(const haptics::Tick& tick, double tip_radius_mm);

  std::vector<FollicleBlob> blobs_;
  std::optional<glm::dvec3> last_P_mm_;  ///< of a curette that presses
  double step_s_ = 0.0;
};

}  // namespace app

// Makes the pieces of a tooth ready for forceps or elevator while one is in the hand: copies what is around them, has
// each piece's site made on a thread of its own (haptics/ligament/piece_site, 0.1 s a piece and once 0.1 s more), and
// orders the servo to use it. Again whenever bone or pieces have changed and lie still. Main thread, once a frame; a
// copy takes 8 ms a piece. Without a tooth of its own it does nothing.
#pragma once

#include <array>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "haptics/ligament/piece_site.h"
#include "haptics/servo/tick.h"

namespace app {

class SiteDesk {
 public:
  /// Before the first tick. Borrows the bodies.
  explicit SiteDesk(const haptics::Bodies& bodies) : bodies_(bodies), sockets_(bodies) {}

  /// `luxates`: forceps or an elevator are in the hand, and the newest command was in force in `newest`. The order's
  /// serial is the caller's. `waits`: for a servo that is stepped, until a site is made.
  std::optional<haptics::SiteOrder> follow(const haptics::Tick& newest, bool luxates, bool waits);
  /// Every piece is ready in the state of the newest tick that was followed.
  bool isReady() const { return ready_; }
  /// As it was made ready last; 0: never.
  double volume_mm3(std::size_t piece) const { return given_[piece].empty() ? 0.0 : given_[piece].back()->volume_mm3; }

 private:
  struct Made {
    std::unique_ptr<haptics::DistanceField> first_socket;  ///< null: there was one
    std::vector<std::unique_ptr<haptics::PieceSite>> sites;
  };
  struct Job {
    std::uint64_t digest = 0;  ///< of the bodies that were copied
    std::vector<std::size_t> pieces;
    std::future<Made> made;
    bool confirmed = false;  ///< the copy is whole: nothing changed until the next frame
    bool spoiled = false;    ///< something did
  };

  void begin(const haptics::Tick& newest);

  const haptics::Bodies& bodies_;
  haptics::SocketSource sockets_;
  std::unique_ptr<haptics::DistanceField> first_socket_;  ///< null: not needed yet
  std::optional<Job> job_;
  std::uint64_t last_digest_ = 0, made_for_ = 0;
  std::vector<std::pair<std::size_t, std::unique_ptr<haptics::PieceSite>>> to_order_;
  std::optional<std::size_t> asked_;  ///< the piece of an order without answer
  /// The servo uses the older until it has taken over the newer.
  std::array<std::vector<std::unique_ptr<haptics::PieceSite>>, haptics::kMaxPieces> given_;
  bool ready_ = false;
};

}  // namespace app

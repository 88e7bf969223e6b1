#include "app/device/hands.h"
#include "app/device/recorded_hand.h"

namespace app {

HandAtWork replayAtWork(const std::string& session, const HandCase&) {
  HandAtWork hand;
  auto recorded = recordedHand(session);
  hand.duration_s = recorded->duration_s();
  hand.rate_Hz = recorded->rate_Hz();
  hand.device = std::move(recorded);
  return hand;
}

}  // namespace app

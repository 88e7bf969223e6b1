#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "haptics/device/pedal/foot_pedal.h"
#include "tests/haptics/starved_threads.h"

namespace haptics {
namespace {

using namespace std::chrono_literals;

TEST(FootPedal, EndsWhenMemoryRunsOutAndReportsIt) {
  starve(true);
  {
    const FootPedal pedal({}, {"/sys/class", "/dev"});
    std::string said = pedal.described();
    // As long as it takes on a busy machine.
    for (int i = 0; i < 30'000 && said == "no pedal found yet"; ++i) {
      std::this_thread::sleep_for(1ms);
      said = pedal.described();
    }
    EXPECT_EQ(said, "the pedal is read no more, memory or handles ran out: close other programs and start again");
    EXPECT_FALSE(pedal.isThere());
    EXPECT_EQ(pedal.held(), HandActions{});
  }
  starve(false);
}

}  // namespace
}  // namespace haptics

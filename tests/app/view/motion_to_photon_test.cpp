#include "app/view/motion_to_photon.h"

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(MotionToPhoton, AddsTheUnmeasuredParts) {
  MotionToPhoton latency(50.0, 1000.0);
  latency.add(0.012);
  const LatencyEstimate e = latency.now();
  EXPECT_DOUBLE_EQ(e.pose_to_swap_ms, 12.0);
  EXPECT_DOUBLE_EQ(e.servo_ms, 0.5);
  EXPECT_DOUBLE_EQ(e.blank_ms, 10.0) << "half a refresh of 20 ms";
  EXPECT_DOUBLE_EQ(e.scan_out_ms, 10.0) << "down to the middle of the panel";
  EXPECT_DOUBLE_EQ(e.total_ms(), 32.5);
}

TEST(MotionToPhoton, SeparatesMedianAndSlowFrames) {
  MotionToPhoton latency(60.0, 1000.0);
  for (int i = 0; i < 100; ++i) latency.add(i < 90 ? 0.010 : 0.040);
  EXPECT_EQ(latency.frames(), 100u);
  EXPECT_NEAR(latency.median().pose_to_swap_ms, 10.0, 0.25);
  EXPECT_NEAR(latency.slow().pose_to_swap_ms, 40.0, 0.25);
}

TEST(MotionToPhoton, HandlesNoFramesAndExtremeValues) {
  MotionToPhoton latency(60.0, 1000.0);
  EXPECT_EQ(latency.median().pose_to_swap_ms, 0.0);
  latency.add(-1.0);
  latency.add(1e6);
  EXPECT_GE(latency.slow().pose_to_swap_ms, 1999.0);
  EXPECT_EQ(latencyText(latency.median()).find('\n'), std::string::npos);
}

}  // namespace
}  // namespace app

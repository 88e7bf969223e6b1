// `poses:FILE`: a hand that is exactly where a pose file has it and asks for what the file asks for.

#include "app/device/pose_csv.h"
#include "app/device/pose_sources.h"
#include "app/text/usage_error.h"
#include "haptics/device/simulated/pose_list_device.h"

namespace app {
namespace {

/// Beyond the last row's time, so that its tick is made as well.
constexpr double kLastTick_s = 1e-6;

void refuseUnlessARehearsal(const std::vector<TimedPose>& poses, const std::string& path) {
  if (poses.front().t_s < 0.0)
    throw UsageError(lineOf(path, poses.front()) + ": t_s is before 0, where a rehearsal begins, shift the times");
  if (poses.back().t_s > kLongestRun_s)
    throw UsageError(lineOf(path, poses.back()) + ": t_s is beyond an hour, give seconds or split the file");
}

}  // namespace

PoseSource openPoses(const std::string& path, const PoseSourceContext&) {
  const std::vector<TimedPose> poses = readPoses(path);
  refuseUnlessARehearsal(poses, path);
  PoseSource hand;
  std::vector<haptics::TimedHandlePose> holds;
  for (const TimedPose& pose : poses) {
    // The device's frame is the patient's, handle and tool are one.
    holds.push_back({pose.t_s, {pose.X_PT.rotation, pose.X_PT.translation_mm}, pose.drill});
    if (!pose.tool.empty() || !pose.action.empty())
      hand.requests.push_back({pose.t_s, pose.tool, pose.action, lineOf(path, pose)});
  }
  auto posed = std::make_unique<haptics::PoseListDevice>(std::move(holds));
  hand.duration_s = posed->duration_s() + kLastTick_s;
  hand.device = std::move(posed);
  return hand;
}

}  // namespace app

// `poses:FILE`: the poses of a file exactly, with the tools and actions that it requests.

#include "app/device/pose_csv.h"
#include "app/device/pose_sources.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

constexpr std::uint32_t kSecondButton = 2;

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
  HandScript script;
  for (const TimedPose& pose : poses) {
    // The device's frame is the patient's, handle and tool coincide.
    script.poses.push_back(
        {pose.t_s, {pose.X_PT.rotation, pose.X_PT.translation_mm}, pose.drill, pose.button ? kSecondButton : 0u});
    if (!pose.tool.empty() || !pose.action.empty())
      script.requests.push_back({pose.t_s, pose.tool, pose.action, lineOf(path, pose)});
  }
  return handAlong(std::move(script), "");
}

}  // namespace app

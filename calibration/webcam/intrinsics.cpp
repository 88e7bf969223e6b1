#include "calibration/webcam/intrinsics.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "calibration/geometry/units.h"
#include "calibration/median.h"
#include "calibration/webcam/camera_file.h"

namespace calibration {
namespace {

constexpr std::size_t kMinSlanted = 3;
constexpr double kMinSlant_deg = 15.0, kMinCovered = 0.5, kMaxRms_px = 1.5;
constexpr glm::ivec2 kFields{6, 4};
constexpr double kWildOfMedian = 2.5, kWild_px = 0.5;  ///< both exceeded: the view does not fit the others

using Positions = std::vector<cv::Point3f>;
using Pixels = std::vector<cv::Point2f>;

[[noreturn]] void refuseLens(const std::string& what, const std::string& mend) {
  throw CalibrationError("lens: " + what + ", " + mend);
}

Positions pointsOf(const std::vector<glm::dvec2>& positions_mm) {
  Positions positions;
  for (const glm::dvec2& mm : positions_mm)
    positions.emplace_back(static_cast<float>(mm.x), static_cast<float>(mm.y), 0.0F);
  return positions;
}

std::vector<Pixels> pixelsOf(const std::vector<BoardView>& views, std::size_t corners) {
  std::vector<Pixels> pixels;
  for (const BoardView& view : views) {
    if (view.corners_px.size() != corners)
      refuseLens("'" + view.name + "' has another number of corners than the board", "use images of one board");
    Pixels& of_view = pixels.emplace_back();
    for (const glm::dvec2& px : view.corners_px) {
      if (!std::isfinite(px.x) || !std::isfinite(px.y))
        refuseLens("'" + view.name + "' has a corner that is not finite", "take it again");
      of_view.emplace_back(static_cast<float>(px.x), static_cast<float>(px.y));
    }
  }
  return pixels;
}

double coveredShare(const glm::ivec2& size_px, const std::vector<Pixels>& views) {
  std::set<std::pair<int, int>> fields;
  for (const Pixels& view : views)
    for (const cv::Point2f& px : view)
      fields.emplace(std::clamp(static_cast<int>(px.x * float(kFields.x) / float(size_px.x)), 0, kFields.x - 1),
                     std::clamp(static_cast<int>(px.y * float(kFields.y) / float(size_px.y)), 0, kFields.y - 1));
  return double(fields.size()) / (kFields.x * kFields.y);
}

struct LensFit {
  cv::Matx33d K = cv::Matx33d::eye();
  cv::Mat distortion, view_rms_px;
  std::vector<cv::Mat> rotations;
  double rms_px = 0.0;
};
LensFit fitted(const glm::ivec2& size_px, const Positions& positions, const std::vector<Pixels>& views) {
  LensFit fit;
  cv::Mat K;
  std::vector<cv::Mat> moves;
  cv::Mat unused_lens, unused_poses;
  try {
    fit.rms_px = cv::calibrateCamera(std::vector<Positions>(views.size(), positions), views, {size_px.x, size_px.y}, K,
                                     fit.distortion, fit.rotations, moves, unused_lens, unused_poses, fit.view_rms_px,
                                     cv::CALIB_FIX_K3);
  } catch (const cv::Exception&) {
    refuseLens("no lens fits the views", "take them again, the board flat, sharp and slanted");
  }
  fit.K = K;
  return fit;
}

/// Between board normal and optical axis.
double slant_deg(const cv::Mat& rotation) {
  cv::Matx33d R;
  cv::Rodrigues(rotation, R);
  return degreesFromRad(std::acos(std::min(1.0, std::abs(R(2, 2)))));
}

CameraModel modelOf(const glm::ivec2& size_px, const LensFit& fit) {
  const auto bent = [&](int i) { return fit.distortion.at<double>(i); };
  CameraModel camera{size_px, {fit.K(0, 0), fit.K(1, 1)}, {fit.K(0, 2), fit.K(1, 2)}, bent(0), bent(1), bent(2),
                     bent(3)};
  if (!std::isfinite(fit.rms_px) || !implausibleParameter(camera).empty())
    refuseLens("the fitted lens is implausible", "slant the board more, and fill the image with it");
  return camera;
}

void checkVariety(const LensFit& fit, double covered_share) {
  std::size_t slanted = 0;
  for (const cv::Mat& rotation : fit.rotations) slanted += slant_deg(rotation) >= kMinSlant_deg;
  if (slanted < kMinSlanted)
    refuseLens("the board was faced squarely in nearly all views", "slant it by 20 to 40 degrees, each way");
  if (covered_share < kMinCovered)
    refuseLens("the views cover " + std::to_string(std::lround(100.0 * covered_share)) + " % of the image",
               "show the board in all its corners");
}

}  // namespace

Intrinsics fitIntrinsics(const glm::ivec2& size_px, const std::vector<glm::dvec2>& positions_mm,
                         const std::vector<BoardView>& views) {
  if (size_px.x < 16 || size_px.y < 16 || positions_mm.size() < 6) refuseLens("no board or no image", "give both");
  if (views.size() < kMinViews)
    refuseLens(std::to_string(views.size()) + " views are too few", "take 12 to 15, the board slanted each way");
  const Positions positions = pointsOf(positions_mm);
  const std::vector<Pixels> all = pixelsOf(views, positions.size());

  // Remove the worst view while it does not fit the others.
  std::vector<std::size_t> used(views.size());
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = i;
  Intrinsics result;
  result.view_rms_px.assign(views.size(), 0.0);
  for (;;) {
    std::vector<Pixels> pixels;
    for (const std::size_t i : used) pixels.push_back(all[i]);
    const LensFit fit = fitted(size_px, positions, pixels);
    std::vector<double> rms_px;
    for (std::size_t k = 0; k < used.size(); ++k)
      rms_px.push_back(result.view_rms_px[used[k]] = fit.view_rms_px.at<double>(static_cast<int>(k)));
    const std::size_t worst = static_cast<std::size_t>(std::ranges::max_element(rms_px) - rms_px.begin());
    const double worst_px = rms_px[worst];
    if (worst_px > kWild_px && worst_px > kWildOfMedian * medianOf(rms_px)) {
      result.left_out.push_back(views[used[worst]].name);
      if (3 * result.left_out.size() > views.size())
        refuseLens("more than a third of the views do not fit the others",
                   "hold camera and board still, lock the focus");
      used.erase(used.begin() + static_cast<std::ptrdiff_t>(worst));
      continue;
    }
    if (!(fit.rms_px < kMaxRms_px))
      refuseLens("the views do not fit together", "hold camera and board still, lock the focus, keep the board flat");
    result.covered_share = coveredShare(size_px, pixels);
    for (const cv::Mat& rotation : fit.rotations)
      result.max_slant_deg = std::max(result.max_slant_deg, slant_deg(rotation));
    checkVariety(fit, result.covered_share);
    result.camera = modelOf(size_px, fit);
    result.rms_px = fit.rms_px;
    return result;
  }
}

}  // namespace calibration

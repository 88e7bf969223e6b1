#include "app/calibrate/lens_text.h"

#include <nlohmann/json.hpp>

#include "app/text/printed.h"

namespace app {

using namespace calibration;

Verdict verdictOfLens(const Intrinsics& lens) {
  if (lens.rms_px <= kGoodLens_px) return Verdict::green;
  return lens.rms_px <= kFairLens_px ? Verdict::amber : Verdict::red;
}

std::string lensText(const Intrinsics& lens, const std::vector<std::string>& refused) {
  const CameraModel& camera = lens.camera;
  std::string text;
  for (const std::string& line : refused) text += "left out: " + line + "\n";
  for (const std::string& name : lens.left_out) text += "left out: " + name + ": it does not fit the others\n";
  text +=
      printed("%d views used, %d left out; corners cover %.0f %% of the picture, boards slanted up to %.0f degrees\n",
              static_cast<int>(lens.view_rms_px.size() - lens.left_out.size()),
              static_cast<int>(lens.left_out.size() + refused.size()), 100.0 * lens.covered_share, lens.most_slant_deg);
  text += printed("focal length (%.1f, %.1f) px, centre (%.1f, %.1f) px, distortion k1 %+.4f, k2 %+.4f\n",
                  camera.focal_px.x, camera.focal_px.y, camera.centre_px.x, camera.centre_px.y, camera.k1, camera.k2);
  const Verdict verdict = verdictOfLens(lens);
  text += std::string(nameOf(verdict)) + printed(": corners are found back to %.2f px RMS; ", lens.rms_px);
  if (verdict == Verdict::green) return text + "within 0.3 px\n";
  return text + (verdict == Verdict::amber ? "above 0.3 px: " : "above 0.6 px: ") +
         "hold camera and board still, lock the focus, keep the board flat\n";
}

std::string lensJson(const Intrinsics& lens, const std::vector<std::string>& refused) {
  const CameraModel& camera = lens.camera;
  nlohmann::ordered_json json;
  json["size_px"] = {camera.size_px.x, camera.size_px.y};
  json["focal_px"] = {camera.focal_px.x, camera.focal_px.y};
  json["centre_px"] = {camera.centre_px.x, camera.centre_px.y};
  json["distortion"] = {camera.k1, camera.k2, camera.p1, camera.p2};
  json["rms_px"] = lens.rms_px;
  json["views"] = lens.view_rms_px.size() - lens.left_out.size();
  json["left_out"] = refused;
  for (const std::string& name : lens.left_out) json["left_out"].push_back(name + ": it does not fit the others");
  json["covered_share"] = lens.covered_share;
  json["most_slant_deg"] = lens.most_slant_deg;
  json["verdict"] = nameOf(verdictOfLens(lens));
  return json.dump(1) + "\n";
}

}  // namespace app

#include "calibration/fit/touches_file.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

#include "calibration/arm/phantom_models.h"
#include "calibration/checked_yaml.h"
#include "calibration/geometry/units.h"

namespace calibration {
namespace {

constexpr std::size_t kMostTouches = 10'000;
constexpr double kFarthest_mm = 2000.0, kMostTurned_rad = 4.0 * kPi;
constexpr double kFinest_mm = 1e-4, kCoarsest_mm = 50.0;
constexpr int kLargestId = 1'000'000;

std::string knownModels() {
  std::string names;
  for (const PhantomModel& model : kPhantomModels) names += (names.empty() ? "" : ", ") + std::string(model.key);
  return names;
}

/// One entry of the list; `name` is how refusals call it.
class TouchReader {
 public:
  TouchReader(const CheckedYaml& yaml, const cv::FileNode& node, std::size_t place)
      : yaml_(yaml), node_(node), name_("observation " + std::to_string(place + 1)) {}

  Touch touch() const {
    if (!node_.isMap()) yaml_.refuse(name_ + " is no map", "write { id, joints_rad: [6], p_W_mm: [3], used }");
    Touch touch;
    touch.id = whole("id", kLargestId);
    if (!node_["used"].empty()) touch.used = whole("used", 1) == 1;
    const auto joints = within("joints_rad", touch.joints_rad.size(), kMostTurned_rad, "two turns", "give radians");
    std::ranges::copy(joints, touch.joints_rad.begin());
    const auto place = within("p_W_mm", 3, kFarthest_mm, "2 m", "give mm in frame W");
    touch.target_W = {{place[0], place[1], place[2]}};
    return touch;
  }

 private:
  int whole(const char* key, int most) const {
    const cv::FileNode node = node_[key];
    const int value = node.isInt() ? static_cast<int>(node) : -1;
    if (value < 0 || value > most)
      yaml_.refuse(name_ + ": '" + key + "' is not a whole number from 0 to " + std::to_string(most), "correct it");
    return value;
  }

  std::vector<double> within(const char* key, std::size_t count, double most, const char* limit,
                             const char* mend) const {
    const auto values = yaml_.numbers(node_[key], name_ + ": " + key, count);
    if (std::ranges::any_of(values, [&](double v) { return std::abs(v) > most; }))
      yaml_.refuse(name_ + ": '" + key + "' holds a number beyond " + limit, mend);
    return values;
  }

  const CheckedYaml& yaml_;
  cv::FileNode node_;
  std::string name_;
};

TouchPrecision precisionIn(const CheckedYaml& yaml) {
  const auto sigma_mm = yaml.numbers(yaml.root()["precision_mm"], "precision_mm", 2);
  for (const double sigma : sigma_mm)
    if (sigma < kFinest_mm || sigma > kCoarsest_mm)
      yaml.refuse("'precision_mm' is not between 0.0001 and 50 mm",
                  "give one sigma of a touch, in plane and along sight");
  return {sigma_mm[0], sigma_mm[1]};
}

}  // namespace

TouchSet readTouches(const std::string& path) {
  const CheckedYaml yaml("observations file", path);
  const cv::FileNode root = yaml.root();
  TouchSet set;
  set.device_model = yaml.text(root, "device_model");
  if (!findPhantomModel(set.device_model))
    yaml.refuse("device_model '" + set.device_model + "' is not known", "give one of " + knownModels());
  for (const auto& [key, text] :
       {std::pair{"serial", &set.serial}, std::pair{"mount", &set.mount}, std::pair{"method", &set.method}})
    if (yaml.has(root, key)) *text = yaml.text(root, key);
  if (yaml.has(root, "precision_mm")) set.precision = precisionIn(yaml);

  const cv::FileNode list = root["observations"];
  if (!list.isSeq() || list.size() == 0)
    yaml.refuse("'observations' is missing or no list", "collect touches (molar calibrate collect)");
  if (list.size() > kMostTouches)
    yaml.refuse("it has more than " + std::to_string(kMostTouches) + " observations", "give those of one procedure");
  set.touches.reserve(list.size());
  for (const cv::FileNode& node : list) set.touches.push_back(TouchReader(yaml, node, set.touches.size()).touch());
  return set;
}

std::string touchesText(const TouchSet& set) {
  cv::FileStorage out("touches.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  out << "device_model" << set.device_model;
  if (!set.serial.empty()) out << "serial" << set.serial;
  if (!set.mount.empty()) out << "mount" << set.mount;
  if (!set.method.empty()) out << "method" << set.method;
  out << "precision_mm"
      << "[:" << set.precision.in_plane_mm << set.precision.along_sight_mm << "]";
  out << "observations"
      << "[";
  for (const Touch& touch : set.touches) {
    out << "{"
        << "id" << touch.id << "joints_rad"
        << "[:";
    for (const double angle_rad : touch.joints_rad) out << angle_rad;
    out << "]"
        << "p_W_mm"
        << "[:" << touch.target_W.mm.x << touch.target_W.mm.y << touch.target_W.mm.z << "]"
        << "used" << (touch.used ? 1 : 0) << "}";
  }
  out << "]";
  return out.releaseAndGetString();
}

}  // namespace calibration

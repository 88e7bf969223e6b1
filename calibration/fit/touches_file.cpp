#include "calibration/fit/touches_file.h"

#include <algorithm>

#include <opencv2/core.hpp>

#include "calibration/arm/phantom_models.h"
#include "calibration/geometry/units.h"
#include "calibration/yaml_writer.h"

namespace calibration {
namespace {

constexpr std::size_t kMaxTouches = 10'000;
constexpr double kFinest_mm = 1e-4, kCoarsest_mm = 50.0;
constexpr int kLargestId = 1'000'000;

Touch touchIn(const CheckedYaml& yaml, const cv::FileNode& node, std::size_t index) {
  const std::string where = "observation " + std::to_string(index + 1);
  if (!node.isMap()) yaml.refuse(where + " is not a map", "write { id, joints_rad: [6], p_W_mm: [3], used }");
  Touch touch;
  touch.id = yaml.integer(node, "id", 0, kLargestId, where + ": ");
  if (yaml.has(node, "used")) touch.used = yaml.integer(node, "used", 0, 1, where + ": ") == 1;
  touch.joints_rad = jointsIn(yaml, node, where);
  const auto mm = yaml.numbers(node["p_W_mm"], where + ": p_W_mm", 3, kFarthest);
  touch.target_W = {{mm[0], mm[1], mm[2]}};
  return touch;
}

TouchPrecision precisionIn(const CheckedYaml& yaml) {
  const auto sigma_mm = yaml.numbers(yaml.root()["precision_mm"], "precision_mm", 2);
  for (const double sigma : sigma_mm)
    if (sigma < kFinest_mm || sigma > kCoarsest_mm)
      yaml.refuse("'precision_mm' is not between 0.0001 and 50 mm",
                  "give one sigma of a touch, in plane and along sight");
  return {sigma_mm[0], sigma_mm[1]};
}

}  // namespace

RawJoints jointsIn(const CheckedYaml& yaml, const cv::FileNode& node, const std::string& where) {
  RawJoints joints_rad{};
  constexpr CheckedYaml::Limit kTwoTurns{4.0 * kPi, "two turns", "give radians"};
  std::ranges::copy(yaml.numbers(node["joints_rad"], where + ": joints_rad", joints_rad.size(), kTwoTurns),
                    joints_rad.begin());
  return joints_rad;
}

TouchSet readTouches(const std::string& path) {
  const CheckedYaml yaml("observations file", path);
  const cv::FileNode root = yaml.root();
  TouchSet set;
  set.device_model = yaml.text(root, "device_model");
  if (!findPhantomModel(set.device_model))
    yaml.refuse("device_model '" + set.device_model + "' is not known", "give one of " + phantomModelKeys());
  for (const auto& [key, text] :
       {std::pair{"serial", &set.serial}, std::pair{"mount", &set.mount}, std::pair{"method", &set.method}})
    if (yaml.has(root, key)) *text = yaml.text(root, key);
  if (yaml.has(root, "precision_mm")) set.precision = precisionIn(yaml);

  const cv::FileNode list = root["observations"];
  if (!list.isSeq() || list.size() == 0)
    yaml.refuse("'observations' is missing or not a list", "collect touches (molar calibrate collect)");
  if (list.size() > kMaxTouches)
    yaml.refuse("it has more than " + std::to_string(kMaxTouches) + " observations", "give those of one procedure");
  set.touches.reserve(list.size());
  for (const cv::FileNode& node : list) set.touches.push_back(touchIn(yaml, node, set.touches.size()));
  return set;
}

std::string touchesText(const TouchSet& set) {
  YamlWriter yaml;
  yaml.put("device_model", set.device_model);
  for (const auto& [key, text] :
       {std::pair{"serial", &set.serial}, std::pair{"mount", &set.mount}, std::pair{"method", &set.method}})
    if (!text->empty()) yaml.put(key, *text);
  yaml.put("precision_mm", glm::dvec2(set.precision.in_plane_mm, set.precision.along_sight_mm));
  yaml.openList("observations");
  for (const Touch& touch : set.touches)
    yaml.map({}, {{"id", touch.id},
                  {"joints_rad", touch.joints_rad},
                  {"p_W_mm", touch.target_W.mm},
                  {"used", touch.used ? 1 : 0}});
  yaml.close();
  return yaml.text();
}

}  // namespace calibration

#include "app/options/jaw_clicks_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <variant>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/text/usage_error.h"
#include "assets/json_depth.h"
#include "assets/toml_reader.h"
#include "assets/tooth.h"

namespace app {
namespace {

using nlohmann::json;

constexpr std::size_t kMostBytes = 1u << 24, kMostWay = 2000;
constexpr double kMostCoordinate_mm = 1e5;
constexpr std::string_view kCanal = "canal", kBrush = "brush", kCut = "cut", kBone = "bone", kNothing = "nothing";

class ClicksReader {
 public:
  explicit ClicksReader(const std::string& name) : name_(name) {}

  assets::JawClicks read(const std::string& text) {
    const json file = assets::isNestedTooDeep(text) ? json() : json::parse(text, nullptr, false);
    if (!file.is_object() || file.size() != 1 || !file.contains("clicks") || !file.at("clicks").is_array())
      throw UsageError("--clicks " + name_ +
                       R"(: it is not {"clicks": [{"edit": "canal", "at_P_mm": [[x, y, z], …]}, …]})");
    const json& list = file.at("clicks");
    if (list.size() > kMostClicks)
      throw UsageError(
          fmt::format("--clicks {}: it holds {} clicks, give at most {}", name_, list.size(), kMostClicks));
    for (const json& one : list) {
      ++number_;
      add(one);
    }
    return std::move(clicks_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw UsageError(fmt::format("--clicks {}, click {}: {}", name_, number_, why));
  }

  void add(const json& click) {
    if (!click.is_object() || !click.contains("edit") || !click.at("edit").is_string())
      refuse("'edit' is missing, give " + names());
    const std::string& edit = click.at("edit").get_ref<const std::string&>();
    const bool is_brush = edit == kBrush;
    for (const auto& [key, value] : click.items())
      if (key != "edit" && key != "at_P_mm" &&
          (is_brush ? key != "radius_mm" && key != "as" && key != "grey_hu" : key != "fdi"))
        refuse(is_brush ? "a key is not edit, at_P_mm, radius_mm, as or grey_hu, remove it"
                        : "a key is not edit, fdi or at_P_mm, remove it");
    const std::vector<glm::dvec3> points = pointsIn(click);
    if (is_brush) return addStroke(click, points);
    if (edit == kCut) {
      if (points.size() != 3) refuse("cut needs 3 points: both ends of a line, and one of what goes");
      clicks_.voxels.emplace_back(assets::JawCut{points[0], points[1], points[2]});
      return;
    }
    if (edit == kCanal) {
      if (points.size() < assets::kLeastCanalClicks || points.size() > assets::kMostCanalClicks)
        refuse(fmt::format("a canal has {} to {} points, from one end to the other", assets::kLeastCanalClicks,
                           assets::kMostCanalClicks));
      clicks_.canals.push_back(points);
      return;
    }
    const auto named = std::ranges::find(assets::kToothEdits, edit);
    if (named == assets::kToothEdits.end()) refuse("'edit' is unknown, give " + names());
    assets::ToothClick tooth;
    tooth.edit = static_cast<assets::ToothEdit>(named - assets::kToothEdits.begin());
    const std::size_t count = assets::pointsOf(tooth.edit);
    if (points.size() != count) refuse(fmt::format("{} needs {} point{}", edit, count, count == 1 ? "" : "s"));
    std::ranges::copy(points, tooth.at_P_mm.begin());
    tooth.fdi = numberIn(click, tooth.edit);
    clicks_.teeth.push_back(tooth);
  }

  void addStroke(const json& click, const std::vector<glm::dvec3>& way_P_mm) {
    assets::BrushStroke stroke;
    if (way_P_mm.empty() || way_P_mm.size() > kMostWay) refuse(fmt::format("brush needs 1 to {} points", kMostWay));
    stroke.way_P_mm = way_P_mm;
    const json radius = click.value("radius_mm", json());
    if (!radius.is_number() || radius < assets::kLeastBrush_mm || radius > assets::kMostBrush_mm)
      refuse(fmt::format("'radius_mm' is missing, give {} to {}", assets::kLeastBrush_mm, assets::kMostBrush_mm));
    stroke.radius_mm = radius.get<double>();
    const json as = click.value("as", json());
    if (as == std::string(kBone))
      stroke.as = assets::kPaintBone;
    else if (as == std::string(kNothing))
      stroke.as = assets::kPaintNothing;
    else if (as.is_number_integer() && isLowerTooth(as.get<std::int64_t>()))
      stroke.as = as.get<std::uint8_t>();
    else
      refuse(R"('as' is missing, give a tooth of the lower jaw as 48, "bone" or "nothing")");
    if (click.contains("grey_hu")) {
      const json& range = click.at("grey_hu");
      if (!range.is_array() || range.size() != 2 || !range[0].is_number() || !range[1].is_number() ||
          !(range[0].get<double>() <= range[1].get<double>()))
        refuse("'grey_hu' is not [low, high] in HU");
      stroke.low_hu = range[0].get<double>(), stroke.high_hu = range[1].get<double>();
    }
    clicks_.voxels.emplace_back(std::move(stroke));
  }

  static bool isLowerTooth(std::int64_t fdi) {
    return fdi >= 31 && fdi <= 48 && assets::isToothNumber(static_cast<int>(fdi));
  }

  static std::string names() {
    std::string list;
    for (const std::string_view name : assets::kToothEdits) list += std::string(name) + ", ";
    return list + "canal, brush or cut";
  }

  std::vector<glm::dvec3> pointsIn(const json& click) const {
    if (!click.contains("at_P_mm") || !click.at("at_P_mm").is_array()) refuse("'at_P_mm' is missing, give [[x, y, z]]");
    std::vector<glm::dvec3> points;
    for (const json& point : click.at("at_P_mm")) {
      if (!point.is_array() || point.size() != 3) refuse("a point of 'at_P_mm' is not three numbers");
      glm::dvec3 at_P_mm{0.0};
      for (int a = 0; a < 3; ++a) {
        const json& number = point.at(static_cast<std::size_t>(a));
        if (!number.is_number() || !(std::abs(number.get<double>()) < kMostCoordinate_mm))
          refuse("a point of 'at_P_mm' is not three numbers in mm");
        at_P_mm[a] = number.get<double>();
      }
      points.push_back(at_P_mm);
    }
    return points;
  }

  int numberIn(const json& click, assets::ToothEdit edit) const {
    const bool has_number = click.contains("fdi");
    if (edit != assets::ToothEdit::number) {
      if (has_number) refuse("'fdi' belongs to number alone, remove it");
      return 0;
    }
    if (!has_number || !click.at("fdi").is_number_integer()) refuse("'fdi' is missing, give the tooth's number as 48");
    const auto fdi = click.at("fdi").get<std::int64_t>();
    if (!isLowerTooth(fdi)) refuse("'fdi' is no tooth of the lower jaw, give 31 to 38 or 41 to 48");
    return static_cast<int>(fdi);
  }

  const std::string& name_;
  assets::JawClicks clicks_;
  std::size_t number_ = 0;
};

json pointsText(std::span<const glm::dvec3> points_P_mm) {
  json list = json::array();
  for (const glm::dvec3& p : points_P_mm) list.push_back({p.x, p.y, p.z});
  return list;
}

json voxelEditText(const assets::VoxelEdit& edit) {
  if (const auto* const cut = std::get_if<assets::JawCut>(&edit)) {
    const std::array points{cut->from_P_mm, cut->to_P_mm, cut->beyond_P_mm};
    return {{"edit", std::string(kCut)}, {"at_P_mm", pointsText(points)}};
  }
  const auto& stroke = std::get<assets::BrushStroke>(edit);
  json text{{"edit", std::string(kBrush)},
            {"at_P_mm", pointsText(stroke.way_P_mm)},
            {"radius_mm", stroke.radius_mm},
            {"as", stroke.as == assets::kPaintNothing ? json(std::string(kNothing))
                   : stroke.as == assets::kPaintBone  ? json(std::string(kBone))
                                                      : json(stroke.as)}};
  const assets::BrushStroke any;
  if (stroke.low_hu != any.low_hu || stroke.high_hu != any.high_hu)
    text["grey_hu"] = json::array({stroke.low_hu, stroke.high_hu});
  return text;
}

}  // namespace

std::string jawClicksText(const assets::JawClicks& clicks) {
  json list = json::array();
  for (const assets::ToothClick& click : clicks.teeth) {
    const std::span<const glm::dvec3> points(click.at_P_mm.data(), assets::pointsOf(click.edit));
    list.push_back({{"edit", std::string(assets::kToothEdits[static_cast<std::size_t>(click.edit)])},
                    {"at_P_mm", pointsText(points)}});
    if (click.edit == assets::ToothEdit::number) list.back()["fdi"] = click.fdi;
  }
  for (const std::vector<glm::dvec3>& canal : clicks.canals)
    list.push_back({{"edit", std::string(kCanal)}, {"at_P_mm", pointsText(canal)}});
  for (const assets::VoxelEdit& edit : clicks.voxels) list.push_back(voxelEditText(edit));
  return json{{"clicks", list}}.dump(1) + "\n";
}

assets::JawClicks jawClicksFrom(const std::string& text, const std::string& name) {
  return ClicksReader(name).read(text);
}

assets::JawClicks readJawClicks(const std::string& path) {
  return jawClicksFrom(assets::readSmallFile(path, kMostBytes, "check the name"), path);
}

}  // namespace app

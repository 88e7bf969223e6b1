#include "app/check_page/check_edits.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/options/jaw_clicks_file.h"
#include "app/text/usage_error.h"
#include "assets/json_depth.h"

namespace app {
namespace {

using nlohmann::json;

constexpr double kSameLength_mm = 0.01;

json entryOf(const CheckEdit& edit) {
  if (const auto* const word = std::get_if<CanalWord>(&edit))
    return {{"edit", word->is_good ? "confirm-canal" : "refuse-canal"},
            {"side", word->is_right ? "right" : "left"},
            {"length_mm", word->length_mm}};
  assets::JawClicks one;
  if (const auto* const tooth = std::get_if<assets::ToothClick>(&edit)) one.teeth.push_back(*tooth);
  if (const auto* const canal = std::get_if<CanalClicks>(&edit)) one.canals.push_back(canal->at_P_mm);
  if (const auto* const stroke = std::get_if<assets::BrushStroke>(&edit)) one.voxels.emplace_back(*stroke);
  if (const auto* const cut = std::get_if<assets::JawCut>(&edit)) one.voxels.emplace_back(*cut);
  json entry = json::parse(jawClicksText(one)).at("clicks").at(0);
  if (const auto* const canal = std::get_if<CanalClicks>(&edit)) entry["side"] = canal->is_right ? "right" : "left";
  return entry;
}

CheckEdit editOf(json entry, const std::string& name) {
  const auto refuse = [&name] { return UsageError(name + ": it does not hold edits of the check page, remove it"); };
  if (!entry.is_object() || !entry.contains("edit") || !entry.at("edit").is_string()) throw refuse();
  const std::string edit = entry.at("edit");
  const bool is_canal = entry.contains("side");
  const bool is_right = is_canal && entry.at("side") == "right";
  if (is_canal && !is_right && entry.at("side") != "left") throw refuse();
  if (edit == "confirm-canal" || edit == "refuse-canal") {
    if (!is_canal || !entry.contains("length_mm") || !entry.at("length_mm").is_number()) throw refuse();
    return CanalWord{is_right, edit == "confirm-canal", entry.at("length_mm").get<double>()};
  }
  entry.erase("side");
  const assets::JawClicks clicks = jawClicksFrom(json{{"clicks", json::array({std::move(entry)})}}.dump(), name);
  if (!clicks.teeth.empty()) return clicks.teeth.front();
  if (!clicks.voxels.empty()) return std::visit([](const auto& one) { return CheckEdit(one); }, clicks.voxels.front());
  if (!is_canal) throw refuse();
  return CanalClicks{is_right, clicks.canals.front()};
}

}  // namespace

CheckEdits::CheckEdits(const assets::JawClicks& clicks, double middle_x_P_mm) {
  for (const assets::ToothClick& click : clicks.teeth) add(click);
  for (const std::vector<glm::dvec3>& canal : clicks.canals) {
    double x_P_mm = 0.0;
    for (const glm::dvec3& p : canal) x_P_mm += p.x / static_cast<double>(canal.size());
    add(CanalClicks{x_P_mm < middle_x_P_mm, canal});
  }
  for (const assets::VoxelEdit& edit : clicks.voxels) std::visit([this](const auto& one) { add(one); }, edit);
}

bool CheckEdits::add(CheckEdit edit) {
  if (done_ == kMost) return false;
  edits_.resize(done_);
  edits_.push_back(std::move(edit));
  ++done_;
  return true;
}

bool CheckEdits::undo() {
  if (done_ == 0) return false;
  --done_;
  return true;
}

bool CheckEdits::redo() {
  if (done_ == edits_.size()) return false;
  ++done_;
  return true;
}

void CheckEdits::drop() {
  if (!undo()) return;
  edits_.resize(done_);
}

assets::JawClicks CheckEdits::clicks() const {
  assets::JawClicks clicks;
  const CanalClicks* canals[2] = {nullptr, nullptr};
  for (std::size_t n = 0; n < done_; ++n) {
    if (const auto* const tooth = std::get_if<assets::ToothClick>(&edits_[n])) clicks.teeth.push_back(*tooth);
    if (const auto* const canal = std::get_if<CanalClicks>(&edits_[n])) canals[canal->is_right ? 0 : 1] = canal;
    if (const auto* const stroke = std::get_if<assets::BrushStroke>(&edits_[n])) clicks.voxels.emplace_back(*stroke);
    if (const auto* const cut = std::get_if<assets::JawCut>(&edits_[n])) clicks.voxels.emplace_back(*cut);
  }
  for (const CanalClicks* const canal : canals)
    if (canal != nullptr) clicks.canals.push_back(canal->at_P_mm);
  return clicks;
}

const CanalClicks* CheckEdits::canalOn(bool is_right) const {
  const CanalClicks* found = nullptr;
  for (std::size_t n = 0; n < done_; ++n)
    if (const auto* const canal = std::get_if<CanalClicks>(&edits_[n]); canal != nullptr && canal->is_right == is_right)
      found = canal;
  return found;
}

std::optional<bool> CheckEdits::wordOn(bool is_right, double length_mm) const {
  std::optional<bool> said;
  for (std::size_t n = 0; n < done_; ++n)
    if (const auto* const word = std::get_if<CanalWord>(&edits_[n]); word != nullptr && word->is_right == is_right) {
      said.reset();
      if (std::abs(word->length_mm - length_mm) < kSameLength_mm) said = word->is_good;
    }
  return said;
}

CheckEdits CheckEdits::inForce() const {
  CheckEdits some = *this;
  some.edits_.resize(done_);
  return some;
}

bool CheckEdits::isLike(const CheckEdits& other) const {
  return std::equal(edits_.begin(), edits_.begin() + static_cast<std::ptrdiff_t>(done_), other.edits_.begin(),
                    other.edits_.begin() + static_cast<std::ptrdiff_t>(other.done_));
}

std::string CheckEdits::text(bool is_saved) const {
  json list = json::array();
  for (const CheckEdit& edit : edits_) list.push_back(entryOf(edit));
  return json{{"edits", list}, {"done", done_}, {"saved", is_saved}}.dump() + "\n";
}

CheckEdits CheckEdits::fromText(const std::string& text, const std::string& name) {
  const json file = assets::isNestedTooDeep(text) ? json() : json::parse(text, nullptr, false);
  if (!file.is_object() || !file.contains("edits") || !file.at("edits").is_array() || !file.contains("done") ||
      !file.at("done").is_number_unsigned() || file.at("edits").size() > kMost ||
      file.at("done").get<std::size_t>() > file.at("edits").size())
    throw UsageError(name + ": it does not hold edits of the check page, remove it");
  CheckEdits edits;
  for (const json& entry : file.at("edits")) edits.edits_.push_back(editOf(entry, name));
  edits.done_ = file.at("done").get<std::size_t>();
  edits.was_saved_ = file.contains("saved") && file.at("saved") == true;
  return edits;
}

std::size_t placeInWay(const std::vector<glm::dvec3>& line, const glm::dvec3& point) {
  std::size_t best = 1;
  double least_mm = 1e18;
  for (std::size_t n = 1; n < line.size(); ++n) {
    const double longer_mm =
        glm::distance(line[n - 1], point) + glm::distance(point, line[n]) - glm::distance(line[n - 1], line[n]);
    if (longer_mm < least_mm) least_mm = longer_mm, best = n;
  }
  return std::min(best, line.size());
}

std::vector<glm::dvec3> withPoint(std::vector<glm::dvec3> line, const glm::dvec3& point) {
  line.insert(line.begin() + static_cast<std::ptrdiff_t>(placeInWay(line, point)), point);
  return line;
}

}  // namespace app

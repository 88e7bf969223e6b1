#include "app/session/session_text.h"

#include <cmath>
#include <cstdlib>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/session/canals_text.h"
#include "app/session/fragments_event.h"
#include "app/session/session_error.h"
#include "assets/json_depth.h"
#include "assets/synthetic/practice_block.h"
#include "assets/synthetic/preparation_block.h"
#include "assets/tissue.h"
#include "assets/tooth.h"

namespace app {
namespace {

using nlohmann::json;

std::string dumped(const json& object) { return object.dump(-1, ' ', false, json::error_handler_t::replace); }

json objectFrom(std::string_view text, const char* what) {
  json object = assets::isNestedTooDeep(text) ? json() : json::parse(text, nullptr, false);
  if (!object.is_object()) throw damagedSession(std::string("the text on ") + what + " cannot be read");
  return object;
}

/// `otherwise` where the object has no such key.
template <class T>
T valueOf(const json& object, const char* key, T otherwise) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return otherwise;
  bool fits = found->is_string();
  if constexpr (std::is_same_v<T, double>) fits = found->is_number();
  if constexpr (std::is_integral_v<T>) fits = found->is_number_integer();
  if constexpr (std::is_same_v<T, bool>) fits = found->is_boolean();
  if (!fits) throw damagedSession(std::string("it has no valid value of ") + key);
  return found->template get<T>();
}

template <class T>
std::optional<T> valueOf(const json& object, const char* key, const std::optional<T>& otherwise) {
  return object.contains(key) ? std::optional(valueOf(object, key, T{})) : otherwise;
}

json jsonOf(const auto& value) { return value; }
template <class T>
json jsonOf(const std::optional<T>& value) {
  return value ? json(*value) : json();
}

json calibrationJson(const SessionCalibration& calibration) {
  json object = json::object();
  forEachField(calibration, [&](const char* key, const auto& value) {
    if (json one = jsonOf(value); !one.is_null()) object[key] = std::move(one);
  });
  return object;
}

SessionCalibration calibrationFrom(const json& object) {
  SessionCalibration calibration;
  forEachField(calibration, [&](const char* key, auto& value) { value = valueOf(object, key, value); });
  return calibration;
}

/// Visits each parameter with its key.
void forEachParameter(auto& jaw, auto&& visit) {
  auto& [right_side, winter_angle_deg, depth_mm, mandibular_canal_distance_mm, spacing_mm, seed, opening_mm] = jaw;
  visit("right_side", right_side), visit("winter_angle_deg", winter_angle_deg), visit("depth_mm", depth_mm);
  visit("mandibular_canal_distance_mm", mandibular_canal_distance_mm), visit("spacing_mm", spacing_mm);
  visit("seed", seed), visit("opening_mm", opening_mm);
}

/// Whether there is a handpiece is the device's, not the tray's.
void forEachNumber(auto& tool, auto&& visit) {
  auto& [head, shaft, handpiece, grips, elevator, hand_instrument, file] = tool;
  auto& [kind, radius_mm, length_mm, profile] = head;
  auto& [shaft_radius_mm, shaft_length_mm] = shaft;
  visit("radius_mm", radius_mm), visit("length_mm", length_mm);
  visit("shaft_radius_mm", shaft_radius_mm), visit("shaft_length_mm", shaft_length_mm);
}

json fileJson(const haptics::CanalFile& file) {
  const auto& [size, length_mm, nickel_titanium, bent_deg, bent_mm, bent_towards_deg, stop_mm, cone_taper, sealer_mm3] =
      file;
  return {{"size", size},
          {"length_mm", length_mm},
          {"bent_deg", bent_deg},
          {"nickel_titanium", nickel_titanium},
          {"bent_mm", bent_mm},
          {"bent_towards_deg", bent_towards_deg},
          {"stop_mm", stop_mm},
          {"cone_taper", cone_taper},
          {"sealer_mm3", sealer_mm3}};
}

haptics::CanalFile fileFrom(const json& object) {
  haptics::CanalFile file;
  auto& [size, length_mm, nickel_titanium, bent_deg, bent_mm, bent_towards_deg, stop_mm, cone_taper, sealer_mm3] = file;
  const int hundredths = valueOf(object, "size", 0);
  if (hundredths < 0) throw damagedSession("it has no valid tray");
  size = static_cast<std::uint64_t>(hundredths);
  length_mm = valueOf(object, "length_mm", length_mm);
  nickel_titanium = valueOf(object, "nickel_titanium", nickel_titanium);
  bent_deg = valueOf(object, "bent_deg", bent_deg);
  bent_mm = valueOf(object, "bent_mm", bent_mm);
  bent_towards_deg = valueOf(object, "bent_towards_deg", bent_towards_deg);
  stop_mm = valueOf(object, "stop_mm", stop_mm);
  cone_taper = valueOf(object, "cone_taper", cone_taper);
  sealer_mm3 = valueOf(object, "sealer_mm3", sealer_mm3);
  return file;
}

json gridJson(const assets::VolumeGrid& grid) {
  return {{"size", {grid.size.x, grid.size.y, grid.size.z}},
          {"spacing_mm", grid.spacing_mm},
          {"origin_P_mm", {grid.origin_P_mm.x, grid.origin_P_mm.y, grid.origin_P_mm.z}}};
}

assets::VolumeGrid gridFrom(const json& about, const char* name = "grid") {
  const auto found = about.find(name);
  assets::VolumeGrid grid;
  const auto three = [&](const char* key) -> const json& {
    const auto at = found->find(key);
    if (at == found->end() || !at->is_array() || at->size() != 3)
      throw damagedSession("its bone has no valid position");
    return *at;
  };
  if (found == about.end() || !found->is_object()) throw damagedSession("its bone has no grid");
  const json &size = three("size"), &origin = three("origin_P_mm");
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (!size[i].is_number_integer() || !origin[i].is_number()) throw damagedSession("its bone has no valid position");
    // Checked by refuseInvalidGrid; here only limited to an int.
    const auto voxels = size[i].get<std::int64_t>();
    grid.size[axis] = voxels < 0 || voxels > 1 << 20 ? 0 : static_cast<int>(voxels);
    grid.origin_P_mm[axis] = origin[i].get<double>();
  }
  const auto spacing = found->find("spacing_mm");
  grid.spacing_mm = spacing != found->end() && spacing->is_number() ? spacing->get<double>() : 0.0;
  return grid;
}

json setupJson(const SessionSetup& setup) {
  json object = json::object();
  if (setup.built_in)
    forEachParameter(*setup.built_in, [&](const char* key, const auto& value) { object["built_in"][key] = value; });
  if (!setup.practice.empty()) object["practice"] = setup.practice;
  for (const haptics::Tool& tool : setup.tray) {
    json one = {{"kind", static_cast<int>(tool.head.kind)},
                {"grips", tool.grips},
                {"elevator", static_cast<int>(tool.elevator)},
                {"hand_instrument", static_cast<int>(tool.hand_instrument)}};
    if (tool.head.kind == haptics::ShapeKind::revolved) one["profile"] = static_cast<int>(tool.head.profile);
    if (tool.isFile()) one["file"] = fileJson(tool.file);
    forEachNumber(tool, [&](const char* key, double value) { one[key] = value; });
    object["tray"].push_back(std::move(one));
  }
  if (setup.former)
    object["continues"] = {{"file", setup.former->file},
                           {"duration_s", setup.former->duration_s},
                           {"bone_digest", fmt::format("{:016x}", setup.former->bone_digest)}};
  const auto three = [](const glm::dvec3& v) { return json{v.x, v.y, v.z}; };
  if (setup.site)
    object["site"] = {{"fdi", setup.site->fdi},
                      {"centre_P_mm", three(setup.site->centre_P_mm)},
                      {"axis_P", three(setup.site->axis_P)}};
  for (const glm::dvec3& p : setup.canal_P_mm) object["canal"]["line_P_mm"].push_back(three(p));
  if (!setup.canal_P_mm.empty()) object["canal"]["radius_mm"] = setup.canal_radius_mm;
  if (setup.canals) object["root_canals"] = json::parse(canalsText(*setup.canals));
  if (!setup.fragments.empty()) object["file_fragments"] = json::parse(fragmentsText(setup.fragments));
  if (const auto& prepared = setup.prepared) {
    json axes = json::array();
    for (int axis = 0; axis < 3; ++axis) axes.push_back(three(prepared->frame.axes_P[axis]));
    object["prepared"] = {{"fdi", prepared->fdi},
                          {"ideal", prepared->ideal},
                          {"cervix_P_mm", three(prepared->frame.cervix_P_mm)},
                          {"axes_P", axes}};
    if (!prepared->caries.empty()) object["prepared"]["caries"] = prepared->caries;
    if (prepared->given)
      object["prepared"]["given"] = {{"sha256", prepared->given->digest}, {"grid", gridJson(prepared->given->grid)}};
    if (prepared->bite.closing != assets::Closing::axis)
      object["prepared"]["bite"] = {{"closing", static_cast<int>(prepared->bite.closing)},
                                    {"hinge_P_mm", three(prepared->bite.hinge_P_mm)}};
    if (prepared->opposing)
      object["prepared"]["opposing"] = {{"sha256", prepared->opposing->digest},
                                        {"side", assets::OpposingTeeth::kSide},
                                        {"step_mm", assets::OpposingTeeth::kStep_mm}};
  }
  if (setup.down_P) object["down_P"] = three(*setup.down_P);
  if (setup.proposed.tooth) object["not_confirmed"].push_back("tooth");
  if (setup.proposed.canal) object["not_confirmed"].push_back("canal");
  return object;
}

glm::dvec3 vectorFrom(const json& three) {
  if (!three.is_array() || three.size() != 3) throw damagedSession("it has no valid site");
  glm::dvec3 vector;
  for (int axis = 0; axis < 3; ++axis) {
    const json& number = three[static_cast<std::size_t>(axis)];
    if (!number.is_number() || !(std::abs(number.get<double>()) < 1e5)) throw damagedSession("it has no valid site");
    vector[axis] = number.get<double>();
  }
  return vector;
}

bool isDigest(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

assets::PreparedTooth preparedFrom(const json& object) {
  constexpr std::size_t kLongestName = 200;
  assets::PreparedTooth prepared;
  const auto bad = [] { return damagedSession("it has no valid prepared tooth"); };
  if (!object.is_object() || !object.contains("cervix_P_mm") || !object.contains("axes_P")) throw bad();
  prepared.fdi = valueOf(object, "fdi", 0);
  prepared.ideal = valueOf(object, "ideal", std::string());
  prepared.frame.cervix_P_mm = vectorFrom(object["cervix_P_mm"]);
  const json& axes = object["axes_P"];
  if (!assets::isToothNumber(prepared.fdi) || prepared.ideal.empty() || prepared.ideal.size() > kLongestName ||
      !axes.is_array() || axes.size() != 3)
    throw bad();
  for (int axis = 0; axis < 3; ++axis) prepared.frame.axes_P[axis] = vectorFrom(axes[static_cast<std::size_t>(axis)]);
  const glm::dmat3 unit = glm::transpose(prepared.frame.axes_P) * prepared.frame.axes_P;
  for (int axis = 0; axis < 3; ++axis)
    if (!(glm::distance(unit[axis], glm::dmat3(1.0)[axis]) < 1e-3)) throw bad();
  prepared.caries = valueOf(object, "caries", std::string());
  if (prepared.caries.size() > kLongestName) throw bad();
  if (const auto given = object.find("given"); given != object.end()) {
    if (!given->is_object()) throw bad();
    prepared.given = assets::GivenIdeal{valueOf(*given, "sha256", std::string()), gridFrom(*given), {}};
    if (!isDigest(prepared.given->digest)) throw bad();
    refuseInvalidGrid(prepared.given->grid);
  }
  if (const auto bite = object.find("bite"); bite != object.end()) {
    const int closing = valueOf(*bite, "closing", -1);
    if (closing < 0 || closing > static_cast<int>(assets::Closing::balance) || !bite->contains("hinge_P_mm"))
      throw bad();
    prepared.bite = {static_cast<assets::Closing>(closing), vectorFrom((*bite)["hinge_P_mm"])};
  }
  if (const auto opposing = object.find("opposing"); opposing != object.end()) {
    if (valueOf(*opposing, "side", 0) != assets::OpposingTeeth::kSide ||
        valueOf(*opposing, "step_mm", 0.0) != assets::OpposingTeeth::kStep_mm)
      throw bad();
    prepared.opposing = assets::OpposingTeeth{valueOf(*opposing, "sha256", std::string()), {}};
    if (const std::string& digest = prepared.opposing->digest; !digest.empty() && !isDigest(digest)) throw bad();
  }
  return prepared;
}

void readSite(const json& object, SessionSetup& setup) {
  if (const auto site = object.find("site"); site != object.end() && site->is_object()) {
    const auto part = [&](const char* key) {
      return site->contains(key) ? vectorFrom(site->at(key)) : glm::dvec3(0.0);
    };
    setup.site = assets::OperativeSite{valueOf(*site, "fdi", 0), part("centre_P_mm"), part("axis_P")};
    const double length = glm::length(setup.site->axis_P);
    if (!assets::isToothNumber(setup.site->fdi) || !(std::abs(length - 1.0) < 1e-3))
      throw damagedSession("it has no valid site");
  }
  if (const auto down = object.find("down_P"); down != object.end()) {
    setup.down_P = vectorFrom(*down);
    if (!(std::abs(glm::length(*setup.down_P) - 1.0) < 1e-3)) throw damagedSession("it has no valid site");
  }
  if (const auto canals = object.find("root_canals"); canals != object.end()) setup.canals = canalsFrom(canals->dump());
  if (const auto metal = object.find("file_fragments"); metal != object.end())
    setup.fragments = fragmentsFrom(metal->dump());
  if (const auto prepared = object.find("prepared"); prepared != object.end()) setup.prepared = preparedFrom(*prepared);
  const auto canal = object.find("canal");
  if (canal == object.end() || !canal->is_object()) return;
  setup.canal_radius_mm = valueOf(*canal, "radius_mm", 0.0);
  if (!(setup.canal_radius_mm >= 0.0 && setup.canal_radius_mm < 100.0)) throw damagedSession("it has no valid site");
  const auto line = canal->find("line_P_mm");
  if (line == canal->end() || !line->is_array()) return;
  for (const json& p : *line) setup.canal_P_mm.push_back(vectorFrom(p));
}

SessionSetup setupFrom(const json& object) {
  SessionSetup setup;
  readSite(object, setup);
  if (const auto jaw = object.find("built_in"); jaw != object.end() && jaw->is_object()) {
    setup.built_in.emplace();
    forEachParameter(*setup.built_in, [&](const char* key, auto& value) { value = valueOf(*jaw, key, value); });
  }
  // One of another version is as an imported patient: its bone is in the session.
  setup.practice = valueOf(object, "practice", std::string());
  if (!assets::practiceTaskOf(setup.practice) && assets::preparationBlockOf(setup.practice) == nullptr)
    setup.practice.clear();
  if (const auto list = object.find("not_confirmed"); list != object.end() && list->is_array())
    for (const json& what : *list) {
      if (what == "tooth") setup.proposed.tooth = true;
      if (what == "canal") setup.proposed.canal = true;
    }
  if (const auto tray = object.find("tray"); tray != object.end() && tray->is_array())
    for (const json& one : *tray) {
      if (!one.is_object()) throw damagedSession("it has no valid tray");
      haptics::Tool tool;
      const int kind = valueOf(one, "kind", 0);
      tool.grips = valueOf(one, "grips", false);
      const int elevator = valueOf(one, "elevator", 0);
      if (elevator < 0 || elevator > static_cast<int>(haptics::ElevatorKind::cryer_right))
        throw damagedSession("it has no valid tray");
      tool.elevator = static_cast<haptics::ElevatorKind>(elevator);
      const int by_hand = valueOf(one, "hand_instrument", 0);
      if (by_hand < 0 || by_hand > static_cast<int>(haptics::HandInstrument::root_plugger))
        throw damagedSession("it has no valid tray");
      tool.hand_instrument = static_cast<haptics::HandInstrument>(by_hand);
      const int profile = valueOf(one, "profile", 0);
      if (kind < 0 || kind >= haptics::kShapeKinds || profile < 0 || profile >= static_cast<int>(assets::kBurProfiles))
        throw damagedSession("it has no valid tray");
      tool.head.kind = static_cast<haptics::ShapeKind>(kind);
      tool.head.profile = static_cast<assets::BurProfile>(profile);
      if (const auto file = one.find("file"); file != one.end() && file->is_object()) tool.file = fileFrom(*file);
      forEachNumber(tool, [&](const char* key, double& value) { value = valueOf(one, key, value); });
      setup.tray.push_back(haptics::sanitised(tool));
    }
  if (const auto former = object.find("continues"); former != object.end() && former->is_object())
    setup.former = {valueOf(*former, "file", std::string()), valueOf(*former, "duration_s", 0.0),
                    std::strtoull(valueOf(*former, "bone_digest", std::string()).c_str(), nullptr, 16)};
  return setup;
}

json ownLabels() {
  json labels = json::array();
  for (const assets::TissueProperties& tissue : assets::kTissues) labels.push_back(tissue.key);
  return labels;
}

LabelTable labelsFrom(const json& stored) {
  std::vector<std::string_view> keys;
  if (stored.is_array())
    for (const json& key : stored)
      keys.push_back(key.is_string() ? std::string_view(key.get_ref<const std::string&>()) : "");
  return labelsOfKeys(keys);
}

}  // namespace

RemovedByTissue removedByKey(std::span<const double> removed_mm3_by_tissue) {
  RemovedByTissue removed;
  for (std::size_t t = 0; t < std::min<std::size_t>(removed_mm3_by_tissue.size(), assets::kTissues.size()); ++t)
    if (removed_mm3_by_tissue[t] != 0.0) removed[std::string(assets::kTissues[t].key)] = removed_mm3_by_tissue[t];
  return removed;
}

std::string removedText(const RemovedByTissue& removed_mm3) { return dumped(json(removed_mm3)); }

RemovedByTissue removedFromText(std::string_view text) {
  RemovedByTissue removed;
  const json object = text.empty() ? json::object() : objectFrom(text, "the removed volume");
  for (const auto& [key, value] : object.items()) {
    if (!value.is_number()) throw damagedSession("it has no valid removed volume");
    removed[key] = value.get<double>();
  }
  return removed;
}

LabelTable labelsOfKeys(std::span<const std::string_view> keys) {
  LabelTable own{};
  for (std::size_t label = 0; label < std::min(keys.size(), own.size()); ++label)
    for (std::size_t tissue = 0; tissue < assets::kTissues.size(); ++tissue)
      if (keys[label] == assets::kTissues[tissue].key) own[label] = static_cast<std::uint8_t>(tissue);
  return own;
}

void refuseInvalidGrid(const assets::VolumeGrid& grid) {
  constexpr int kMaxVoxelsPerAxis = 4096;
  constexpr std::size_t kMaxVoxels = std::size_t{1} << 31;
  bool usable = std::isfinite(grid.spacing_mm) && grid.spacing_mm > 0.0;
  for (int axis = 0; axis < 3; ++axis)
    usable =
        usable && grid.size[axis] >= 1 && grid.size[axis] <= kMaxVoxelsPerAxis && std::isfinite(grid.origin_P_mm[axis]);
  if (!usable || grid.voxelCount() > kMaxVoxels) throw damagedSession("its bone has no valid size");
}

std::string aboutText(const SessionStart& start) {
  json about = {{"program", start.program_version},
                {"patient", start.patient_title},
                {"servo_revision", start.servo.revision},
                {"instruction_set", start.servo.instruction_set},
                {"dt_s", start.dt_s},
                {"grid", gridJson(start.grid)},
                {"labels", ownLabels()},
                {"calibration", calibrationJson(start.calibration)},
                {"setup", setupJson(start.setup)},
                {"started_utc", start.started_utc}};
  if (start.soft_tissue != nullptr && !start.soft_tissue->isEmpty())
    about["soft_tissue_grid"] = gridJson(start.soft_tissue->grid);
  if (start.laid != nullptr) about["laid_before_age_s"] = start.laid->age_s;
  return dumped(about);
}

SessionAbout aboutFromText(std::string_view text) {
  const json object = objectFrom(text, "the session");
  SessionAbout about;
  about.start.program_version = valueOf(object, "program", std::string());
  about.start.patient_title = valueOf(object, "patient", std::string());
  about.start.servo.revision = valueOf(object, "servo_revision", std::int64_t{0});
  about.start.servo.instruction_set = valueOf(object, "instruction_set", std::string());
  about.start.dt_s = valueOf(object, "dt_s", 0.001);
  about.start.grid = gridFrom(object);
  if (object.contains("soft_tissue_grid")) about.start.soft_tissue.grid = gridFrom(object, "soft_tissue_grid");
  if (const auto found = object.find("labels"); found != object.end()) about.label = labelsFrom(*found);
  if (const auto found = object.find("calibration"); found != object.end()) {
    if (!found->is_object()) throw damagedSession("it has no valid calibration");
    about.start.calibration = calibrationFrom(*found);
  }
  if (const auto found = object.find("setup"); found != object.end() && found->is_object())
    about.start.setup = setupFrom(*found);
  // Recorded when the title alone said so.
  if (!about.start.setup.proposed.any() && about.start.patient_title.ends_with(assets::kNotConfirmedTitle))
    about.start.setup.proposed = {true, true};
  about.start.started_utc = valueOf(object, "started_utc", std::string());
  if (const auto ages = object.find("laid_before_age_s"); ages != object.end() && ages->is_array())
    for (const json& age : *ages) {
      const double age_s = age.is_number() ? age.get<double>() : -1.0;
      if (!(age_s >= 0.0 && age_s < 1e9)) throw damagedSession("it has no valid age of its filling");
      about.laid_before_age_s.push_back(age_s);
    }
  return about;
}

std::string sealText(const SessionEnd& end) {
  json object = {{"ticks", end.ticks}, {"lost", end.lost}};
  if (end.bone_digest) object["bone_digest"] = fmt::format("{:016x}", *end.bone_digest);
  return dumped(object);
}

SessionEnd sealFromText(std::string_view text) {
  const json object = objectFrom(text, "the end");
  SessionEnd end;
  end.ticks = valueOf(object, "ticks", std::uint64_t{0});
  end.lost = valueOf(object, "lost", std::uint64_t{0});
  if (const std::string digest = valueOf(object, "bone_digest", std::string()); !digest.empty())
    end.bone_digest = std::strtoull(digest.c_str(), nullptr, 16);
  return end;
}

}  // namespace app

#include "assets/patient/patient_toml.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "assets/load_error.h"
#include "assets/tooth.h"

namespace assets {

namespace {

constexpr int kSchema = 2, kFormerSchema = 1;
constexpr std::size_t kLongestTitle = 200;
constexpr std::size_t kMostCanalPoints = 10000;
constexpr double kFarthest_mm = 1.0e6;

/// The shortest text that reads back as the same number.
std::string exact(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  std::string number(text.data(), end);
  return number.find_first_of(".e") == std::string::npos ? number + ".0" : number;
}

std::string exact(const glm::dvec3& v) { return "[" + exact(v.x) + ", " + exact(v.y) + ", " + exact(v.z) + "]"; }

/// Reads keys of one table; every refusal names file and key.
class Keys {
 public:
  Keys(const toml::table& root, const char* section, const std::string& where) : section_(section), where_(where) {
    table_ = root[section].as_table();
    if (table_ == nullptr) throw LoadError(where + ": there is no table [" + section + "]; import the scan again");
  }

  double number(const char* key, double lowest, double highest) const {
    return number((*table_)[key], key, lowest, highest);
  }

  bool yesOrNo(const char* key) const {
    const auto* value = (*table_)[key].as_boolean();
    if (value == nullptr) refuse(key, "must be true or false");
    return value->get();
  }

  glm::dvec3 vector(const char* key, double largest) const { return vector((*table_)[key], key, largest); }

  std::vector<glm::dvec3> vectors(const char* key, double largest, std::size_t most) const {
    const toml::array* list = (*table_)[key].as_array();
    if (list == nullptr || list->size() > most)
      refuse(key, "must be a list of at most " + std::to_string(most) + " points");
    std::vector<glm::dvec3> points;
    for (const toml::node& point : *list)
      points.push_back(vector(toml::node_view<const toml::node>(point), key, largest));
    return points;
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& reason) const {
    throw LoadError(where_ + ": " + section_ + "." + key + " " + reason + "; correct it or import the scan again");
  }

 private:
  double number(toml::node_view<const toml::node> node, const char* key, double lowest, double highest) const {
    const auto value = node.value<double>();
    if (!value || !(*value >= lowest && *value <= highest)) {
      std::ostringstream range;
      range << "must be a number from " << lowest << " to " << highest;
      refuse(key, range.str());
    }
    return *value;
  }

  glm::dvec3 vector(toml::node_view<const toml::node> node, const char* key, double largest) const {
    const toml::array* list = node.as_array();
    if (list == nullptr || list->size() != 3) refuse(key, "must be three numbers");
    glm::dvec3 v;
    for (int a = 0; a < 3; ++a) v[a] = number(node[static_cast<std::size_t>(a)], key, -largest, largest);
    return v;
  }

  std::string section_;
  std::string where_;
  const toml::table* table_ = nullptr;
};

std::string titleOf(const toml::table& root, const std::string& where) {
  const auto title = root["title"].value<std::string>();
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (!title || title->size() > kLongestTitle || std::any_of(title->begin(), title->end(), is_control))
    throw LoadError(where + ": title must be one line of at most 200 bytes; correct it or import the scan again");
  return *title;
}

glm::dvec3 unitVector(const Keys& keys, const char* key) {
  const glm::dvec3 direction = keys.vector(key, 1.001);
  if (std::abs(glm::length(direction) - 1.0) > 1.0e-3) keys.refuse(key, "must have length 1");
  return direction;
}

int toothNumber(const Keys& keys, const char* key) {
  const double number = keys.number(key, 11, 85);
  const int fdi = static_cast<int>(number);
  if (fdi != number || !isToothNumber(fdi)) keys.refuse(key, "must be an FDI number, 11 to 48 or 51 to 85");
  return fdi;
}

/// As schema 1 has it: a place and a direction even where no tooth is known.
void readFormerSite(const toml::table& root, const std::string& where, Patient& patient) {
  const Keys keys(root, "site", where);
  const OperativeSite site{toothNumber(keys, "tooth_fdi"), keys.vector("third_molar_P_mm", kFarthest_mm),
                           unitVector(keys, "crown_direction_P")};
  patient.jaw_P_mm = site.centre_P_mm;
  if (keys.yesOrNo("known")) patient.site = site;
}

void readSite(const toml::table& root, const std::string& where, Patient& patient) {
  patient.jaw_P_mm = Keys(root, "jaw", where).vector("place_P_mm", kFarthest_mm);
  if (!root.contains("site")) return;
  const Keys keys(root, "site", where);
  patient.site = {toothNumber(keys, "fdi"), keys.vector("centre_P_mm", kFarthest_mm), unitVector(keys, "axis_P")};
}

toml::table parsed(const std::string& text, const std::string& where) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw LoadError(where + ": line " + std::to_string(error.source().begin.line) +
                    " is no TOML; correct it or import the scan again");
  }
}

}  // namespace

std::string patientToml(const Patient& patient) {
  std::ostringstream text;
  text << "schema = " << kSchema << "\ntitle = " << toml::value<std::string>(patient.title)
       << "\nframe = \"P: LPS, mm\"\n\n[jaw]\nplace_P_mm = " << exact(patient.jaw_P_mm) << '\n';
  if (patient.site)
    text << "\n[site]\nfdi = " << patient.site->fdi << "\ncentre_P_mm = " << exact(patient.site->centre_P_mm)
         << "\naxis_P = " << exact(patient.site->axis_P) << '\n';
  text << "\n[classification]\niso_hu = " << exact(patient.classification.iso_hu)
       << "\nsigma_hu = " << exact(patient.classification.sigma_hu)
       << "\n\n[mandibular_canal]\nradius_mm = " << exact(patient.mandibular_canal_radius_mm) << "\nline_P_mm = [\n";
  for (const glm::dvec3& p_P_mm : patient.mandibular_canal_P_mm) text << "  " << exact(p_P_mm) << ",\n";
  text << "]\n";
  return text.str();
}

Patient patientFromToml(const std::string& text, const std::string& where) {
  const toml::table root = parsed(text, where);
  const auto schema = root["schema"].value<std::int64_t>();
  if (!schema) throw LoadError(where + ": there is no schema; it is no patient of this program, import the scan again");
  if (*schema != kSchema && *schema != kFormerSchema)
    throw LoadError(where + ": its schema is " + std::to_string(*schema) +
                    ", this program reads 1 and 2; import the scan again");

  Patient patient;
  patient.title = titleOf(root, where);
  if (*schema == kFormerSchema)
    readFormerSite(root, where, patient);
  else
    readSite(root, where, patient);
  // Older folders call it canal.
  const Keys canal(root, root.contains("canal") ? "canal" : "mandibular_canal", where);
  patient.mandibular_canal_radius_mm = canal.number("radius_mm", 0.01, 20.0);
  patient.mandibular_canal_P_mm = canal.vectors("line_P_mm", kFarthest_mm, kMostCanalPoints);
  const Keys classification(root, "classification", where);
  patient.classification.iso_hu = classification.number("iso_hu", -32768.0, 32767.0);
  patient.classification.sigma_hu = classification.number("sigma_hu", 1.0e-3, 32767.0);
  return patient;
}

}  // namespace assets

#include "assets/patient/patient_toml.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "assets/toml_reader.h"
#include "assets/tooth.h"

namespace assets {

namespace {

constexpr int kSchema = 2, kOldSchema = 1;
constexpr std::size_t kMaxCanalPoints = 10000;
constexpr double kMaxCoordinate_mm = 1.0e6;

std::string exact(double value) {
  const std::string number = exactText(value);
  return number.find_first_of(".e") == std::string::npos ? number + ".0" : number;
}

std::string exact(const glm::dvec3& v) { return "[" + exact(v.x) + ", " + exact(v.y) + ", " + exact(v.z) + "]"; }

glm::dvec3 unitVector(TomlReader& keys, const char* key, const char* table = "site") {
  const glm::dvec3 direction = keys.vector(table, key, 1.001);
  if (std::abs(glm::length(direction) - 1.0) > 1.0e-3) keys.refuse(table, key, "give a direction of length 1");
  return direction;
}

using HeadPose = calibration::Pose<calibration::Patient, calibration::Face>;

std::string headTable(const HeadPose& X_PF) {
  const glm::dmat3 axes_P = glm::mat3_cast(X_PF.rotation);
  return "\n[head]\nleft_P = " + exact(axes_P[0]) + "\nup_P = " + exact(axes_P[1]) +
         "\norigin_P_mm = " + exact(X_PF.translation_mm) + '\n';
}

HeadPose headIn(TomlReader& keys) {
  const glm::dvec3 left_P = unitVector(keys, "left_P", "head"), up_P = unitVector(keys, "up_P", "head");
  if (std::abs(glm::dot(left_P, up_P)) > 1.0e-3) keys.refuse("head", "up_P", "it is not at a right angle to left_P");
  const glm::dvec3 forward_P = glm::normalize(glm::cross(left_P, up_P));
  return {glm::normalize(glm::quat_cast(glm::dmat3(left_P, glm::cross(forward_P, left_P), forward_P))),
          keys.vector("head", "origin_P_mm", kMaxCoordinate_mm)};
}

int toothNumber(TomlReader& keys, const char* key) {
  const auto fdi = static_cast<int>(keys.integer("site", key, 11, 85));
  if (!isToothNumber(fdi)) keys.refuse("site", key, "give an FDI number, 11 to 48 or 51 to 85");
  return fdi;
}

std::string confirmedLine(const Patient& patient) {
  if (!patient.found) return {};
  const std::string tooth = patient.found->tooth ? "\"tooth\"" : "", canal = patient.found->canal ? "\"canal\"" : "";
  return "confirmed = [" + tooth + (tooth.empty() || canal.empty() ? "" : ", ") + canal + "]\n";
}

/// A list, or of both at once true or false.
std::optional<Confirmation> confirmationIn(TomlReader& keys) {
  if (!keys.has("", "confirmed")) return std::nullopt;
  if (!keys.isList("", "confirmed")) {
    const bool both = keys.boolean("", "confirmed");
    return Confirmation{both, both};
  }
  Confirmation confirmed;
  for (const std::string& what : keys.texts("", "confirmed", 2)) {
    if (what != "tooth" && what != "canal") keys.refuse("", "confirmed", "give \"tooth\", \"canal\" or both");
    (what == "tooth" ? confirmed.tooth : confirmed.canal) = true;
  }
  return confirmed;
}

/// Schema 1 has a position and a direction even where no tooth is known.
void readOldSite(TomlReader& keys, Patient& patient) {
  const OperativeSite site{toothNumber(keys, "tooth_fdi"), keys.vector("site", "third_molar_P_mm", kMaxCoordinate_mm),
                           unitVector(keys, "crown_direction_P")};
  patient.jaw_P_mm = site.centre_P_mm;
  if (keys.boolean("site", "known")) patient.site = site;
}

void readSite(TomlReader& keys, Patient& patient) {
  patient.jaw_P_mm = keys.vector("jaw", "place_P_mm", kMaxCoordinate_mm);
  if (keys.has("site"))
    patient.site = {toothNumber(keys, "fdi"), keys.vector("site", "centre_P_mm", kMaxCoordinate_mm),
                    unitVector(keys, "axis_P")};
}

}  // namespace

std::string patientToml(const Patient& patient) {
  std::ostringstream text;
  text << "schema = " << kSchema << "\ntitle = " << quotedToml(patient.title) << "\nframe = \"P: LPS, mm\"\n"
       << confirmedLine(patient) << (patient.has_built_in_face ? "face = \"built-in\"\n" : "")
       << (patient.has_modelled_gum ? "gum = \"modelled\"\n" : "")
       << "\n[jaw]\nplace_P_mm = " << exact(patient.jaw_P_mm) << '\n';
  if (patient.site)
    text << "\n[site]\nfdi = " << patient.site->fdi << "\ncentre_P_mm = " << exact(patient.site->centre_P_mm)
         << "\naxis_P = " << exact(patient.site->axis_P) << '\n';
  if (patient.X_PF) text << headTable(*patient.X_PF);
  text << "\n[classification]\niso_hu = " << exact(patient.classification.iso_hu)
       << "\nsigma_hu = " << exact(patient.classification.sigma_hu)
       << "\n\n[mandibular_canal]\nradius_mm = " << exact(patient.mandibular_canal_radius_mm) << "\nline_P_mm = [\n";
  for (const glm::dvec3& p_P_mm : patient.mandibular_canal_P_mm) text << "  " << exact(p_P_mm) << ",\n";
  text << "]\n";
  return text.str();
}

Patient patientFromToml(const std::string& text, const std::string& where) {
  TomlReader keys(text, where);
  if (!keys.has("", "schema"))
    keys.refuse("", "schema", "it is missing, so this is not a patient; import the scan again");
  const auto schema = keys.integer("", "schema", 0, std::numeric_limits<int>::max());
  if (schema != kSchema && schema != kOldSchema)
    keys.refuse("", "schema",
                "it is " + std::to_string(schema) + ", this program reads 1 and 2; import the scan again");

  Patient patient;
  patient.title = keys.text("", "title");
  patient.found = confirmationIn(keys);
  patient.has_modelled_gum = keys.has("", "gum") && keys.choice("", "gum", {"modelled"}) == 0;
  patient.has_built_in_face = keys.has("", "face") && keys.choice("", "face", {"built-in"}) == 0;
  if (schema == kOldSchema)
    readOldSite(keys, patient);
  else
    readSite(keys, patient);
  if (keys.has("head")) patient.X_PF = headIn(keys);
  const char* canal = keys.has("canal") ? "canal" : "mandibular_canal";  // the name in older folders
  patient.mandibular_canal_radius_mm = keys.number(canal, "radius_mm", {0.01, 20.0, "mm"});
  patient.mandibular_canal_P_mm = keys.vectors(canal, "line_P_mm", kMaxCoordinate_mm, kMaxCanalPoints);
  patient.classification.iso_hu = keys.number("classification", "iso_hu", {-32768.0, 32767.0, "HU"});
  patient.classification.sigma_hu = keys.number("classification", "sigma_hu", {1.0e-3, 32767.0, "HU"});
  return patient;
}

}  // namespace assets

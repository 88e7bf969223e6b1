#include "app/station/patient_list.h"

#include <algorithm>
#include <ctime>
#include <functional>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/core.h>

#include "app/session/data_folder.h"
#include "app/session/session_error.h"
#include "assets/load_error.h"
#include "assets/patient/patient_folder.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 80;

/// Hidden ones are what a killed import left; what cannot stand in a line of text is no name.
bool isName(const std::string& name) {
  return !name.empty() && name.front() != '.' && assets::printable(name, kLongestName) == name;
}

}  // namespace

fs::path usualPatientFolder() { return dataFolder("patients"); }

std::string newPatientPath(const fs::path& folder, std::int64_t unix_s) {
  const auto seconds = static_cast<std::time_t>(unix_s);
  std::tm local{};
  localtime_r(&seconds, &local);
  const std::string name = fmt::format("imported-{:%Y-%m-%d}", local);
  std::string path = (folder / name).string();
  std::error_code failed;
  for (int n = 2; fs::exists(path, failed); ++n) path = (folder / fmt::format("{}-{}", name, n)).string();
  return path;
}

std::vector<PatientListing> listPatients(const fs::path& folder) {
  std::vector<std::pair<fs::file_time_type, PatientListing>> found;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (!isName(name) || !entry.is_directory(failed)) continue;
    try {
      const assets::Patient patient = assets::describedPatient(entry.path().string());
      found.push_back({fs::last_write_time(entry.path(), failed),
                       {entry.path().string(), name, patient.shownTitle(), patient.isProposed()}});
    } catch (const assets::LoadError&) {  // molar inspect tells why
    }
  }
  std::ranges::sort(found, [](const auto& a, const auto& b) {
    return std::pair(a.first, a.second.name) > std::pair(b.first, b.second.name);
  });
  std::vector<PatientListing> patients;
  for (auto& [written, patient] : found) patients.push_back(std::move(patient));
  return patients;
}

std::string patientNamed(const std::string& text) {
  std::error_code failed;
  if (!isName(text) || text.find('/') != std::string::npos || fs::exists(text, failed)) return text;
  try {
    const fs::path path = usualPatientFolder() / text;
    return fs::is_directory(path, failed) ? path.string() : text;
  } catch (const SessionError&) {
    return text;
  }
}

std::string patientList(const std::vector<PatientListing>& patients) {
  std::string text;
  for (const PatientListing& one : patients) text += fmt::format("{:<24} {}\n", one.name, one.title);
  return text;
}

}  // namespace app

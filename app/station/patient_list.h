// The patients of the data folder: where `molar import` writes unless told otherwise, and what the start screen offers
// beside the built-in cases. A folder's name is what its owner chose ("imported-2026-11-27" until then); nothing of a
// person is added to it. Any thread but the servo; one small file a patient.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace app {

/// dataFolder("patients"). Throws SessionError.
std::filesystem::path usualPatientFolder();

/// A free name in the folder: "imported-2026-11-27" for local time, then "imported-2026-11-27-2".
std::string newPatientPath(const std::filesystem::path& folder, std::int64_t unix_s);

struct PatientListing {
  std::string path;
  std::string name;   ///< of the folder
  std::string title;  ///< "imported scan, lower right third molar (48)"
  /// Tooth or canal were found by the program, and nobody has confirmed them.
  bool is_to_check = false;
};

/// Those whose description can be read, the newest import first. A folder that does not exist is empty.
std::vector<PatientListing> listPatients(const std::filesystem::path& folder);

/// The folder of a patient of the data folder for its name; any other text, and one that is a path here, unchanged.
std::string patientNamed(const std::string& text);

/// Of an argument that names a patient.
inline constexpr const char* kPatientHelp = "Patient folder, or the name of one in the data folder";

/// For people, one line a patient; empty: there is none.
std::string patientList(const std::vector<PatientListing>& patients);

}  // namespace app

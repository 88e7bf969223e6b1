// How an imported DICOM scan was made and what was done to it: the only values of its headers that are kept, and what
// was dropped, in counts. No name, date or identifier of a person. Plain data; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

namespace assets {

/// Groups of elements whose number is told, without their values.
inline constexpr std::array<std::string_view, 7> kDroppedGroups = {"file",  "identification", "patient", "acquisition",
                                                                   "image", "private",        "other"};

enum class GreyScale { hounsfield, shifted, two_points, stated };

struct ScanOrigin {
  std::string modality, manufacturer, model, kernel;  ///< of known lists, else "other"; empty: not stated
  std::optional<double> tube_kv, exposure_mas;        ///< kV, mAs
  std::optional<int> year_band;                       ///< of the scan, rounded to 5 years
  std::optional<int> age_decade;                      ///< only on request
  char sex = ' ';                                     ///< only on request
  int columns = 0, rows = 0, slices = 0;
  double row_spacing_mm = 0.0, column_spacing_mm = 0.0, step_mm = 0.0, tilt_deg = 0.0;
  int bridged_slices = 0;  ///< made by interpolation

  GreyScale scale = GreyScale::hounsfield;
  double slope = 1.0, offset_hu = 0.0;  ///< HU = slope * grey value + offset
  double shading_hu = 0.0;              ///< standard deviation of what was subtracted; 0: nothing

  bool has_face = false;  ///< the skin was kept on request
  double removed_soft_tissue_cm3 = 0.0;
  bool has_burnt_in_text_checked = false;
  int blanked_text_lines = 0;

  int files = 0;
  std::array<std::uint64_t, kDroppedGroups.size()> dropped_elements{};  ///< in all files
};

constexpr std::string_view scaleName(GreyScale scale) {
  constexpr std::array<std::string_view, 4> kNames = {"Hounsfield", "Hounsfield, shifted", "air and soft tissue",
                                                      "stated by the owner"};
  return kNames[static_cast<std::size_t>(scale)];
}

}  // namespace assets

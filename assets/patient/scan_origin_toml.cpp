#include "assets/patient/scan_origin_toml.h"

#include <sstream>

#include "assets/toml_reader.h"

namespace assets {
namespace {

void put(std::ostringstream& text, const char* key, const std::string& value) {
  if (!value.empty()) text << key << " = " << quotedToml(value) << '\n';
}

void put(std::ostringstream& text, const char* key, const std::optional<double>& value) {
  if (value) text << key << " = " << numberText(*value) << '\n';
}

void put(std::ostringstream& text, const char* key, const std::optional<int>& value) {
  if (value) text << key << " = " << *value << '\n';
}

}  // namespace

std::string scanTable(const ScanOrigin& origin) {
  std::ostringstream text;
  text << "\n[scan]\n";
  put(text, "modality", origin.modality);
  put(text, "manufacturer", origin.manufacturer);
  put(text, "model", origin.model);
  put(text, "kernel", origin.kernel);
  put(text, "tube_kV", origin.tube_kv);
  put(text, "exposure_mAs", origin.exposure_mas);
  put(text, "year_to_five", origin.year_band);
  put(text, "age_decade", origin.age_decade);
  if (origin.sex != ' ') put(text, "sex", std::string(1, origin.sex));
  text << "columns_rows_slices = [" << origin.columns << ", " << origin.rows << ", " << origin.slices
       << "]\nrow_column_step_mm = [" << numberText(origin.row_spacing_mm) << ", "
       << numberText(origin.column_spacing_mm) << ", " << numberText(origin.step_mm)
       << "]\ngantry_tilt_deg = " << numberText(origin.tilt_deg) << "\nbridged_slices = " << origin.bridged_slices
       << "\ngrey_scale = " << quotedToml(std::string(scaleName(origin.scale)))
       << "\nhu_per_grey = " << numberText(origin.slope) << "\nhu_offset = " << numberText(origin.offset_hu)
       << "\nshading_sd_hu = " << numberText(origin.shading_hu)
       << "\nrecognisable_face = " << (origin.has_face ? "true" : "false") << '\n';
  return text.str();
}

std::string deidentificationStatement(const ScanOrigin& origin, const std::string& volume_sha256) {
  std::ostringstream text;
  text << "# What this patient folder holds of the DICOM files that it was made from. Done by software, reviewed by\n"
          "# nobody. The shape of teeth and jaws can identify a person: handle the folder as medical data.\n"
          "schema = 1\nprofile = \"allow-list: voxels, geometry and the values below; every other element is dropped "
          "unread\"\n"
          "reviewed = false\n"
          "kept = [\"modality\", \"manufacturer and model of a known list\", \"kernel of a known form\", \"tube "
          "voltage\",\n"
          "  \"exposure\", \"year to five\", \"rows, columns, slices\", \"spacing\", \"step\", \"tilt\", \"slope and "
          "intercept\"";
  if (origin.age_decade || origin.sex != ' ') text << ", \"age in decades\", \"sex\"";
  text << "]\nvolume_sha256 = " << quotedToml(volume_sha256)
       << "\n\n[face]\nkept = " << (origin.has_face ? "true" : "false")
       << "\nsoft_tissue_set_to_air_cm3 = " << numberText(origin.removed_soft_tissue_cm3)
       << "\n\n[pictures]\ntext_in_them_was_checked_by_the_owner = "
       << (origin.has_burnt_in_text_checked ? "true" : "false")
       << "\nblanked_lines_of_text = " << origin.blanked_text_lines
       << "\n\n[dropped_elements]\nfiles = " << origin.files << '\n';
  for (std::size_t group = 0; group < kDroppedGroups.size(); ++group)
    text << kDroppedGroups[group] << " = " << origin.dropped_elements[group] << '\n';
  return text.str();
}

}  // namespace assets

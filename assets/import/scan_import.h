// A patient from a scan: a surveyed DICOM source (dicom/dicom_survey.h); a folder with ct.nrrd and, next to it,
// labels.nrrd (Tissue values) and teeth.nrrd (FDI numbers), or a single volume file in Hounsfield; .nrrd, .nhdr, .nii,
// .nii.gz, .mha, .mhd in any orientation (image_file.h). The site is the requested tooth, or a third molar: one
// numbered in teeth.nrrd, or the only tooth with labelled enamel and dentine if the scan shows its side. The canal's
// line comes from labels. A scan without labels is segmented (assets/segment), from 35 mm on; what holds no lower jaw
// with teeth is refused. Only voxels and geometry are kept: no name, date or identifier, not even the file name.
// Gingiva and face are made elsewhere. Any thread, at start-up; about 2 s per 10^7 voxels.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "assets/import/dicom/dicom_survey.h"
#include "assets/import/found_jaw.h"
#include "assets/import/grey_scale.h"
#include "assets/import/label_table.h"
#include "assets/load_error.h"
#include "assets/patient.h"
#include "assets/scan/grey_window.h"
#include "assets/scan_origin.h"
#include "assets/segment/jaw_segmentation.h"

namespace assets {

struct ScanImportOptions {
  Classification classification{};
  std::optional<int> tooth_fdi{};       ///< the site; default: a third molar
  std::optional<GreyWindow> window{};   ///< for an 8-bit volume
  std::optional<GreyMap> scale{};       ///< HU of the grey values; judged by their histogram otherwise
  bool keep_face = false;               ///< of a DICOM scan: skin farther than 12 mm from bone is not removed
  bool keep_age_band = false;           ///< of a DICOM scan: the patient's age in decades, and sex
  std::optional<std::string> labels{};  ///< a label map from elsewhere (foreign_labels.h), instead of one beside it
  std::optional<LabelSet> label_set{};  ///< whose values those are, where the file does not name them
  /// Makes such a file of the scan's own grey values and returns its path; empty: none is made.
  std::function<std::string(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield)> segment{};
  bool grey_only = false;  ///< without labels: tissues by grey value alone, no jaw and no teeth are looked for
  JawClicks clicks{};      ///< a person's edits of what is found in a scan without labels
  ReportStage stage{};     ///< called when a stage begins
  /// For who waits: the scan's grey values once they are read, and what has been found in them.
  std::function<void(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield)> grey{};
  ReportJaw so_far{};
};

/// No teeth can be found in the scan.
struct JawRefused : LoadError {
  JawRefused(const std::string& name, JawRefusal why)
      : LoadError(name + ": " + why.sentence + "; --grey-only imports it without teeth"), refusal(std::move(why)) {}
  JawRefusal refusal;
};

struct ImportedScan {
  Patient patient;
  std::vector<std::string> remarks;  ///< notes and warnings for the user, a line each
  std::optional<ScanOrigin> origin;  ///< of a DICOM scan
  std::optional<FoundJaw> jaw;       ///< of a scan without labels
};

/// Throws LoadError of one line.
ImportedScan importScan(const std::string& source, const ScanImportOptions& options);

/// Adds what is to be said of the grey values to the survey. Throws LoadError: also what the survey refuses.
ImportedScan importScan(DicomSurvey& survey, const ScanImportOptions& options);

/// A folder of DICOM files without a ct volume beside them, a DICOMDIR, or one DICOM file.
bool isDicomSource(const std::string& source);

}  // namespace assets

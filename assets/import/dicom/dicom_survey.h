// What a DICOM source holds and whether it can become a patient: its volumes, which one is taken, its geometry, and the
// verdicts on all of it. Nothing is guessed: a spacing or a position that the files do not state is refused, or taken
// from what the owner says. Pixels are decoded only where two slices lie at one place. Any thread; a second for 500
// files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/import/dicom/dicom_series.h"
#include "assets/import/dicom/dicom_verdict.h"
#include "assets/scan/resampling.h"

namespace assets {

/// What the owner of a scan says about it.
struct DicomChoices {
  std::optional<int> series{};             ///< its number in the list, from 1
  bool fill_gaps = false;                  ///< up to three missing slices in a row
  bool assume_order = false;               ///< slices in the order of their numbers
  bool spacing_from_thickness = false;     ///< slices touch
  bool burnt_in_checked = false;           ///< text in the pictures was looked at
  std::optional<glm::dvec3> spacing_mm{};  ///< between rows, columns, slices: only where the files state none
  std::vector<std::string> without{};      ///< files to leave out
};

/// How the slices of the taken series become a volume.
struct DicomPlan {
  SliceStack stack;
  EvenSlices even;
  ScanGeometry geometry;
  std::size_t invented_slices = 0;
};

struct DicomSurvey {
  DicomFolder folder;
  SortedDicom sorted;
  std::optional<std::size_t> taken;  ///< in sorted.series
  std::vector<DicomVerdict> verdicts;
  std::optional<DicomPlan> plan;  ///< where nothing stops

  /// The first that stops.
  const DicomVerdict* refusal() const;
};

/// Throws LoadError: nothing there, too much of it, a choice that the source has no place for.
DicomSurvey surveyDicom(const std::string& source, const DicomChoices& choices);

/// Of what a server sent, which outlives the survey.
DicomSurvey surveyDicom(const ReceivedFiles& files, const DicomChoices& choices);

}  // namespace assets

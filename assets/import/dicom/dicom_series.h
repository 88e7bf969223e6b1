// Volumes among the pictures of a folder: grouped by series, size, orientation, pixel spacing and values; groups that
// fill each other's gaps are joined; the one with most slices at the finest spacing is taken, or the one asked for.
// Pure; any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "assets/import/dicom/dicom_folder.h"
#include "assets/import/dicom/slice_stack.h"

namespace assets {

/// A frame of a file.
struct DicomSlice {
  std::size_t file = 0;  ///< in DicomFolder::files
  std::size_t frame = 0;
};

struct DicomSeries {
  std::vector<DicomSlice> slices;
  std::size_t joined = 1;  ///< groups that it is made of
  int rows = 0, columns = 0;
  std::optional<glm::dvec2> spacing_mm;  ///< between rows, between columns
  std::optional<SliceAxes> axes;         ///< none: not stated, or no right angle
  bool has_positions = false;            ///< of every slice
  SliceStack stack;                      ///< where axes and positions are known
};

struct DicomCounts {
  std::size_t files = 0, left_out = 0;
  std::size_t not_dicom = 0, not_images = 0, localizers = 0, captures = 0, other_modalities = 0, small = 0;
};

struct SortedDicom {
  std::vector<DicomSeries> series;  ///< the best first
  DicomCounts counts;
  std::vector<std::size_t> damaged;  ///< files of CT, or of nobody knows what, whose pictures cannot be read
};

/// Of one picture: 64 pixels a side at least, CT, no localizer, no screenshot.
SortedDicom sortDicom(const DicomFolder& folder);

/// Known only from outside: the order of names and numbers, in steps of `step_mm` along the feet-to-head axis.
SliceStack assumedStack(const DicomFolder& folder, const DicomSeries& series, double step_mm);

}  // namespace assets

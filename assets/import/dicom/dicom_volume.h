// The grey values of a surveyed series as one volume in the slices' own axes: decoded, per-slice slope and intercept
// applied, made slices interpolated between their neighbours. Not yet on cubic LPS voxels: scan/resampling.h. Any
// thread.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/import/dicom/dicom_survey.h"
#include "assets/progress.h"

namespace assets {

/// Values of survey.plan->geometry, i fastest; kNoGrey outside the picture. Throws LoadError: the survey refuses, or a
/// file's pictures cannot be decoded, named as it may be.
std::vector<std::int16_t> readDicomVolume(const DicomSurvey& survey, const ReportProgress& report = {});

}  // namespace assets

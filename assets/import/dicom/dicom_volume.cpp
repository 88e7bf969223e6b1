#include "assets/import/dicom/dicom_volume.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "assets/import/dicom/frame_reader.h"
#include "assets/import/dicom/stored_frame.h"
#include "assets/load_error.h"

namespace assets {

std::vector<std::int16_t> readDicomVolume(const DicomSurvey& survey, const ReportProgress& report) {
  if (const DicomVerdict* refusal = survey.refusal()) throw LoadError(lineOf(*refusal));
  assert(survey.plan && survey.taken);
  const DicomSeries& series = survey.sorted.series[*survey.taken];
  const DicomPlan& plan = *survey.plan;
  std::vector<DicomSlice> slices;
  for (const std::size_t n : plan.stack.order) slices.push_back(series.slices[n]);
  const std::size_t pixels = static_cast<std::size_t>(series.rows) * static_cast<std::size_t>(series.columns);
  std::vector<std::int16_t> grey(pixels * slices.size());
  const std::vector<std::size_t> lost = readFrames(survey.folder, slices, grey, report);
  if (!lost.empty()) {
    const DicomFile& file = survey.folder.files[slices[lost.front()].file];
    const bool has_space = file.shown.find(' ') != std::string::npos;
    throw LoadError("scan/" + file.shown +
                    ": its picture is damaged and cannot be decoded; copy it from the CD again, " +
                    "or leave it out with --without " + (has_space ? "'" + file.shown + "'" : file.shown));
  }
  const auto is_itself = [](const MadeSlice& slice) { return slice.share == 0.0; };
  if (plan.even.slices.size() == slices.size() && std::ranges::all_of(plan.even.slices, is_itself)) return grey;

  std::vector<std::int16_t> even(pixels * plan.even.slices.size());
  for (std::size_t n = 0; n < plan.even.slices.size(); ++n) {
    const MadeSlice& slice = plan.even.slices[n];
    const std::int16_t* below = grey.data() + slice.below * pixels;
    const std::int16_t* above = grey.data() + slice.above * pixels;
    for (std::size_t p = 0; p < pixels; ++p) {
      const bool is_outside = below[p] == kNoGrey || above[p] == kNoGrey;
      const double between = (1.0 - slice.share) * below[p] + slice.share * above[p];
      even[n * pixels + p] = slice.share == 0.0   ? below[p]
                             : slice.share == 1.0 ? above[p]
                             : is_outside         ? kNoGrey
                                                  : static_cast<std::int16_t>(std::lround(between));
    }
  }
  return even;
}

}  // namespace assets

// Grey values of many frames. Plain and RLE pixels are read by all threads; compressed ones by two child processes, so
// that a stream made to break a decoder breaks only a child: no open file, signal handler or terminal of the program,
// with limits on memory and time, and what it decodes lands in shared memory whose size is known before. Any thread, at
// start-up. 512 slices of 512 x 512: plain 2 s of CPU, JPEG 2000 about 20 s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/import/dicom/dicom_series.h"
#include "assets/progress.h"

namespace assets {

/// `grey`: rows * columns values for each slice, in that order. Returns which slices could not be read. All slices have
/// the size of the first. Throws what `report` throws, and LoadError for lack of memory or processes.
std::vector<std::size_t> readFrames(const DicomFolder& folder, const std::vector<DicomSlice>& slices,
                                    std::span<std::int16_t> grey, const ReportProgress& report = {});

}  // namespace assets

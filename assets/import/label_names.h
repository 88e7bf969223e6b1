// Names that a file gives to its label values: keys SegmentN_Name and SegmentN_LabelValue of a .seg.nrrd (3D Slicer),
// the label table that TotalSegmentator writes into a NIfTI header's extension, or nnU-Net's dataset.json beside the
// file. Empty where there are none, or they are damaged. At most 1 MB is read. Any thread, at start-up.
#pragma once

#include <map>
#include <string>

namespace assets {

std::map<int, std::string> labelNames(const std::string& path);

/// The single ways, of their text.
std::map<int, std::string> namesInNrrdHeader(const std::string& header);
std::map<int, std::string> namesInLabelTable(const std::string& xml);
std::map<int, std::string> namesInDataset(const std::string& json);

}  // namespace assets

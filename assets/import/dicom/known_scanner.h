// Words of a DICOM header that may be kept because they are on a list: modalities, makers and models of scanners,
// reconstruction kernels by their form. Anything else becomes "other": free text can hold names. Any thread.
#pragma once

#include <string>
#include <string_view>

namespace assets {

/// Of the standard's codes, else "other".
std::string knownModality(std::string_view text);
std::string knownManufacturer(std::string_view text);
std::string knownModel(std::string_view text);
/// As vendors write them: at most 8 letters and digits, with a digit among them (B30s, H60f, FC81), or a word of a
/// list.
std::string knownKernel(std::string_view text);

}  // namespace assets

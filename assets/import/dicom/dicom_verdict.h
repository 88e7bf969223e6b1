// What is to be said of a DICOM folder: a code for programs, a plain sentence for people, and the files it is about by
// the names that may be shown. A verdict that stops is a refusal of the import; others are notes. Texts name no path,
// no patient and nothing that a file holds but numbers. Any thread.
#pragma once

#include <string>
#include <vector>

namespace assets {

struct DicomVerdict {
  std::string code;  ///< F1, S1, G3 …: assets/import/dicom/README.md
  std::string sentence;
  std::vector<std::string> files;
  bool stops = false;
};

/// "scan: …", unless the sentence names its place itself.
std::string lineOf(const DicomVerdict& verdict);

/// "12,345".
std::string withThousands(unsigned long long number);
/// With up to `decimals` decimals, without trailing zeros: "0.4", "15".
std::string shortNumber(double value, int decimals);
/// "37th".
std::string ordinal(std::size_t number);
/// "1 slice", "2 slices".
std::string counted(std::size_t count, const std::string& noun);

}  // namespace assets

// Values of DICOM elements: text, numbers as text or binary, and hashes of identifiers. None where the value is
// missing, longer than 64 KB or no number. Any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/import/dicom/dicom_walk.h"

namespace assets {

/// Without padding at its ends.
std::string textOf(const DicomBytes& bytes, const DicomElement& element);
/// Decimal or integer strings between backslashes, or binary FD and FL; finite, else empty.
std::vector<double> numbersOf(const DicomBytes& bytes, const DicomElement& element, bool is_big_endian);
std::optional<double> numberOf(const DicomBytes& bytes, const DicomElement& element, bool is_big_endian);
/// US, SS, UL or IS.
std::optional<std::int64_t> integerOf(const DicomBytes& bytes, const DicomElement& element, bool is_big_endian);
/// FNV-1a of 64 bits; 0 for an empty value.
std::uint64_t hashOf(const DicomBytes& bytes, const DicomElement& element);

}  // namespace assets

// What one DICOM file says of its pictures: exactly the values that a scan needs, by an allow-list; every other element
// is passed over unread, so that no name, date or identifier of a person is held. Identifiers of study, series and
// frame of reference are kept as 64-bit hashes, to compare. Names of the patient are looked at once, to see whether the
// file's own name gives them away. The file is read up to its pixel data. Never throws for what a file holds: `fault`
// says what is wrong with it. Any thread; microseconds.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "assets/import/dicom/dicom_bytes.h"
#include "assets/import/dicom/dicom_walk.h"
#include "assets/import/dicom/transfer_syntax.h"
#include "assets/scan_origin.h"

namespace assets {

/// Of one frame; what the file does not say is none.
struct DicomPlane {
  std::optional<glm::dvec3> position_P_mm;  ///< centre of the first pixel
  std::optional<glm::dmat2x3> row_column;   ///< directions along a row and along a column, as written
  std::optional<glm::dvec2> spacing_mm;     ///< between rows, between columns: the standard's order
  std::optional<double> thickness_mm;
  double slope = 1.0, intercept = 0.0;
};

struct DicomPixelFormat {
  int bits_allocated = 0, bits_stored = 0, high_bit = 0;
  bool is_signed = false;
  bool is_inverted = false;                             ///< MONOCHROME1
  std::optional<std::uint32_t> padding, padding_limit;  ///< stored values of pixels outside the picture

  bool operator==(const DicomPixelFormat&) const = default;
};

enum class DicomFault {
  none,
  not_dicom,
  unread,          ///< the file is empty or cannot be opened
  damaged,         ///< no data set can be followed to its pixels
  cut,             ///< ends before all its pixels: held_bytes of expected_bytes
  unread_packing,  ///< a transfer syntax that is not read: `unread_name`
  unread_pixels,   ///< not one 8- or 16-bit grey value a pixel
};

enum class DicomKind { image, no_image, localizer, capture };

struct DicomHeader {
  DicomFault fault = DicomFault::none;
  std::uint64_t held_bytes = 0, expected_bytes = 0;
  std::string unread_name;

  DicomKind kind = DicomKind::no_image;
  std::string modality;  ///< one of the standard's codes, else "other"
  bool has_burnt_in_text = false;
  std::string manufacturer, model, kernel;      ///< of a known list, else "other"; empty: not stated
  std::optional<double> tube_kv, exposure_mas;  ///< kV, mAs
  std::optional<int> year_band;                 ///< of the scan, rounded to 5 years
  std::optional<int> age_decade;                ///< of the patient, in years: 20 for 20 to 29
  char sex = ' ';                               ///< M, F, O
  bool name_is_telling = false;                 ///< the file's name holds letters of the patient's name or number

  std::array<std::uint32_t, kDroppedGroups.size()> dropped_elements{};

  std::uint64_t study_key = 0, series_key = 0, frame_of_reference_key = 0;
  std::optional<int> instance;
  int rows = 0, columns = 0, frames = 1;
  DicomPixelFormat format;
  const TransferSyntax* syntax = &kTransferSyntaxes[0];
  bool is_big_endian = false;  ///< of the pixels

  std::vector<DicomPlane> planes;  ///< one a frame
  std::uint64_t data_set_at = 0, pixels_at = 0;
  std::vector<DicomFragment> fragments;  ///< of encapsulated pixels, the table of offsets first; empty: plain

  bool isDicom() const { return fault != DicomFault::not_dicom && fault != DicomFault::unread; }
  std::size_t pixelCount() const { return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns); }
  std::uint64_t frameBytes() const {
    return std::uint64_t{pixelCount()} * static_cast<unsigned>(format.bits_allocated / 8);
  }
};

/// Opens the file's bytes as its header says: inflated where it is deflated. Throws LoadError only where it cannot be
/// opened. `file_name` is compared with the patient's name and shown nowhere.
struct OpenedDicom {
  DicomHeader header;
  DicomBytes bytes;
};
OpenedDicom openDicom(const std::string& path, const std::string& file_name);

/// The bytes that the positions of a header mean: those of its file, inflated where it is deflated.
DicomBytes pixelBytes(DicomBytes bytes, const DicomHeader& header);

/// The same of bytes in memory.
OpenedDicom openDicom(DicomBytes bytes, const std::string& file_name);

}  // namespace assets

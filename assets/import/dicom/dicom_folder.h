// The files of a DICOM source, with their headers: a folder with all that lies below it (links are not followed; at
// most 20,000 files, 8 GB, 8 folders deep), the folder of a DICOMDIR, one file, or what a server sent. Names that may
// be shown are those that say nothing of a person: a word that scanners use and a number, unlike the patient's name and
// numbers; all others are numbers in the order of names. Any thread; about 50 µs a file and the disk.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "assets/import/dicom/dicom_header.h"
#include "assets/import/dicom/received_files.h"

namespace assets {

struct DicomFile {
  std::string path;   ///< for opening alone: never shown; empty: received
  std::string shown;  ///< "IM0005", or "file 12"
  DicomHeader header;
  std::span<const char> received{};

  /// The bytes that the header's positions mean. Throws LoadError where the file cannot be opened any more.
  DicomBytes pixels() const;
};

struct DicomFolder {
  std::vector<DicomFile> files;  ///< in the order of names
  std::size_t left_out = 0;      ///< by --without
};

/// Whether a source is DICOM: a file or folder with at least one; a folder with a ct volume is not asked.
bool holdsDicom(const std::string& source);

/// `without`: names as shown, or as they are on the disk. Throws LoadError: nothing there, too much of it, or a name in
/// `without` that is not there.
DicomFolder readDicomFolder(const std::string& source, const std::vector<std::string>& without);

/// Of closed files that outlive the answer; each is a number in the order in which they came.
DicomFolder readDicomFolder(const ReceivedFiles& files, const std::vector<std::string>& without);

/// A path with # for each number: the same for files of one series.
std::string numberedName(const std::string& path);

/// Whether a file's name may be shown, whatever the patient is called.
bool isPlainFileName(const std::string& name);

}  // namespace assets

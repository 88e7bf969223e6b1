// The trailer of a closed session: a digest of every byte of the file behind its last page, where SQLite does not look.
// The chain finds changed rows; this also finds a byte changed between them. Any thread; reads the whole file.
#pragma once

#include <string>

namespace app {

/// none: a file without trailer, as a killed program leaves it. incomplete: the beginning of the right one and nothing
/// or zeros behind, as a power cut leaves it. broken: some byte of the file was changed, or its end was cut off.
enum class FileSeal { none, incomplete, intact, broken };

/// Appends the trailer to a file that is open for reading and writing, and waits until it is on the disk. `path` is
/// what to call it. Throws SessionError if that can not be.
void sealFile(int file, const std::string& path);

FileSeal fileSeal(const std::string& path);

/// Whether the file was written as a session, whatever became of it: the mark of its header or that of its trailer.
/// False for what is no plain file.
bool hasSessionMark(const std::string& path);

/// Whether it begins as an SQLite database does.
bool isDatabase(const std::string& path);

/// Whether the file says that a log belongs to it (SQLite's WAL mode): it was being recorded, and never closed.
bool needsLog(const std::string& path);

}  // namespace app

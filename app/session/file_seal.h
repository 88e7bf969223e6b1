// The trailer of a closed session: a digest of every byte of the file, behind the last page of the database. The chain
// finds changed rows; the seal also finds bytes changed between them. Any thread; reads the whole file.
#pragma once

#include <string>

namespace app {

/// none: no trailer, as after a kill. incomplete: the beginning of the right one, then nothing or zeros, as after a
/// power cut. broken: a byte of the file was changed, or its end was cut off.
enum class FileSeal { none, incomplete, intact, broken };

/// Appends the trailer to a file open for reading and writing, and syncs it. `path` is for messages. Throws
/// SessionError.
void sealFile(int file, const std::string& path);

FileSeal fileSeal(const std::string& path);

/// Whether the file was written as a session, even if damaged since: the mark of its header or of its trailer. False if
/// it is not a regular file.
bool hasSessionMark(const std::string& path);

/// Whether it starts like an SQLite database.
bool isDatabase(const std::string& path);

/// Whether the file is in SQLite's WAL mode, so that a log belongs to it: recorded, and never closed.
bool needsLog(const std::string& path);

}  // namespace app

// The trailer of a closed session: a digest of every byte of the file behind its last page, where SQLite does not look.
// The chain finds changed rows; this also finds a byte changed between them. Any thread; reads the whole file.
#pragma once

#include <string>

namespace app {

enum class FileSeal { none, intact, broken };

/// Appends the trailer. Throws SessionError if the file can not be read or written.
void sealFile(const std::string& path);

/// none: a file without trailer, as a killed program leaves it. broken: some byte of the file was changed.
FileSeal fileSeal(const std::string& path);

/// Whether the file was written as a session, whatever became of it: the mark of its header or that of its trailer.
bool bearsSessionMark(const std::string& path);

}  // namespace app

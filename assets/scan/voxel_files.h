// The names by which a header points at the files with its voxels. A header is a stranger's: what it names is looked up
// in the header's own folder or below, never by an absolute path, through "..", or through a link that leads out.
// Throws LoadError of one line. Any thread.
#pragma once

#include <string>
#include <vector>

#include "assets/scan/image_header.h"

namespace assets {

/// Whether the entry says that a list of names follows ("LIST", "LIST 2"), and is no name itself.
bool isList(const std::string& entry);

/// The file of that name beside the header.
VoxelFile dataFile(const std::string& header_path, const std::string& name);

/// All of those names, which must be as many as expected.
std::vector<VoxelFile> listedDataFiles(const std::string& header_path, const std::vector<std::string>& names,
                                       std::uint64_t expected);

/// All the files of "NAME%03d.raw", numbered from `first` to `last` by `step`. Exactly one number in the name (%d, %i,
/// %u with an optional width); no other conversion.
struct NumberedNames {
  std::string pattern;
  std::int64_t first = 1;
  std::int64_t last = 1;
  std::int64_t step = 1;

  /// 0 where the numbers make no sense.
  std::uint64_t count() const;
};
std::vector<VoxelFile> numberedDataFiles(const std::string& header_path, const NumberedNames& names,
                                         std::uint64_t expected);

}  // namespace assets

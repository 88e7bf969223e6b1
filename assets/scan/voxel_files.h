// Data files named by a header. They must lie in the header's folder or below: no absolute path, no "..", no link that
// leads out. Throws LoadError of one line. Any thread.
#pragma once

#include <string>
#include <vector>

#include "assets/scan/image_header.h"

namespace assets {

/// Whether the entry announces a list of names ("LIST", "LIST 2").
bool isList(const std::string& entry);

/// The file of that name, relative to the header.
VoxelFile dataFile(const std::string& header_path, const std::string& name);

/// All of these, which must be as many as expected.
std::vector<VoxelFile> listedDataFiles(const std::string& header_path, const std::vector<std::string>& names,
                                       std::uint64_t expected);

/// All the files of "NAME%03d.raw", numbered from `first` to `last` by `step`. Exactly one number in the name (%d, %i,
/// %u with an optional width); no other conversion.
struct NumberedNames {
  std::string pattern;
  std::int64_t first = 1;
  std::int64_t last = 1;
  std::int64_t step = 1;

  /// 0 for an invalid range.
  std::uint64_t count() const;
};
std::vector<VoxelFile> numberedDataFiles(const std::string& header_path, const NumberedNames& names,
                                         std::uint64_t expected);

}  // namespace assets

// Fields of an NRRD header by name, and the lines after "data file: LIST". Checks names only; values are not
// interpreted. Throws LoadError of one line. Any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "assets/scan/regular_file.h"

namespace assets {

/// Names in lower case and without spaces.
class NrrdFields {
 public:
  /// Throws if it is no NRRD file, or a field is unknown or repeated.
  explicit NrrdFields(const RegularFile& file);

  const std::string& path() const { return path_; }
  bool has(const std::string& name) const { return value_.contains(name); }
  /// Empty if absent.
  std::string operator[](const std::string& name) const;
  /// Throws if absent.
  std::string required(const std::string& name) const;

  /// The words of a field; a vector "(1,0,0)" or a quoted text is one word.
  std::vector<std::string> items(const std::string& name) const;
  /// Throws unless there are `count`; none if the field is absent.
  std::vector<std::string> items(const std::string& name, std::size_t count) const;

  const std::vector<std::string>& listedFiles() const { return listed_files_; }
  /// Offset of attached voxels.
  std::uint64_t endByte() const { return end_byte_; }

  [[noreturn]] void refuseField(const std::string& name) const;
  /// Adds the advice to export the volume again.
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  std::string path_;
  std::map<std::string, std::string> value_;
  std::vector<std::string> listed_files_;
  std::uint64_t end_byte_ = 0;
};

}  // namespace assets

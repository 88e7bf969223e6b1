// An outside command that labels a scan: `TotalSegmentator -i {ct} -o {labels} --ml -ta teeth`. It gets the grey values
// as a NIfTI file in a private folder, without anything of the person, and no environment but what programs need to
// start; no shell reads the line. What it prints goes to standard error. Main thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "assets/volume_grid.h"

namespace app {

class PrivateFolder;

class Segmenter {
 public:
  /// Throws UsageError: no program, an open quote, or {ct} or {labels} missing.
  explicit Segmenter(const std::string& command);
  ~Segmenter();
  Segmenter(const Segmenter&) = delete;
  Segmenter& operator=(const Segmenter&) = delete;

  /// Runs it; the path of the label map, which lives as long as this object. Throws LoadError: it cannot be started,
  /// fails, takes longer than `limit`, or leaves no label map.
  std::string labels(const assets::VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                     std::chrono::seconds limit = std::chrono::hours(3));
  /// Where the map lies; empty: none was made.
  std::string folder() const;

 private:
  std::vector<std::string> words_;
  std::unique_ptr<PrivateFolder> folder_;
};

/// Words at white space outside of '…' and "…". Throws UsageError for an open quote.
std::vector<std::string> wordsOfCommand(const std::string& line);

}  // namespace app

// The stages of an import as they go by: which one is worked on, how long each took, and what share of the whole is
// done. Shares are estimates: by how long the stages take on a usual whole jaw, and how much faster or slower those
// were that are done. Time is given, in seconds of any clock. Plain values; any one thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace app {

struct ImportStage {
  enum class State { waits, runs, done };

  std::string name;
  double usual_s = 0.0;  ///< on two cores; 0: not counted in the whole
  State state = State::waits;
  double begun_s = 0.0, took_s = 0.0;
};

class ImportStages {
 public:
  explicit ImportStages(std::vector<ImportStage> expected) : stages_(std::move(expected)) {}

  /// The one before ends. Those expected before it that did not begin are left out; one that nobody expected comes
  /// next.
  void begin(std::string_view name, double at_s);
  void end(double at_s);

  const std::vector<ImportStage>& all() const { return stages_; }
  /// The one that is worked on; null: none.
  const ImportStage* running() const;
  double secondsOf(const ImportStage& stage, double at_s) const;
  /// 0 to 1; that of one that is worked on is an estimate and stays below 1.
  double shareOf(const ImportStage& stage, double at_s) const;
  /// Of the whole; does not fall while stages begin in the expected order.
  double share(double at_s) const;

 private:
  /// How much longer than usual stages take here.
  double slowness() const;

  std::vector<ImportStage> stages_;
};

/// Of a DICOM scan without labels (512 x 512 x 471 voxels of 0.35 mm, two busy cores), to the end of its writing.
std::vector<ImportStage> expectedImportStages();

}  // namespace app

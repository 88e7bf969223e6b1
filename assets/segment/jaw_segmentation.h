// A lower jaw out of a grey cone-beam scan without labels: mandible, teeth, tissues. Classical image analysis, no
// learned model; the stages are the files of this folder, in the order of the README. What it finds is a proposal that
// a person must see before it is measured on. Hounsfield values may be off by a tenth: levels are taken from the jaw
// itself. Any thread but the servo; parallel (TBB), the same labels for any number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/segment/canal_path.h"
#include "assets/segment/grey_levels.h"
#include "assets/segment/jaw_clicks.h"
#include "assets/segment/jaw_verdict.h"
#include "assets/segment/tooth_numbers.h"
#include "assets/volume_grid.h"

namespace assets {

struct Mandible;
struct ToothRegions;

struct JawSegmentation {
  std::optional<JawRefusal> refusal;  ///< then nothing else is set
  std::vector<std::uint8_t> label;    ///< Tissue, on the scan's grid
  std::vector<std::uint8_t> tooth;    ///< FDI number
  GreyLevels levels;
  std::vector<FoundTooth> teeth;  ///< from the right to the left along the arch, those without a number too
  std::vector<CanalProposal> canals;
};

/// Called when a stage begins, with its name.
using ReportStage = std::function<void(std::string_view stage)>;

/// What is known while the rest is looked for, on the scan's grid; valid during the call. Null: not yet.
struct JawSoFar {
  const Mandible* jaw = nullptr;
  const ToothRegions* teeth = nullptr;      ///< without numbers
  const JawSegmentation* labels = nullptr;  ///< then the others are null
};
using ReportJaw = std::function<void(const JawSoFar& jaw)>;

/// What clicks on teeth make of them, before canals that they change are found anew: those are as they were.
using ShowTeeth = std::function<void(JawSegmentation teeth)>;

/// A jaw found once, to be looked at and clicked in again and again: clicks change what was found, and only what they
/// change is computed anew, tooth by tooth. 0.1 to 0.3 s for a click on a tooth at 0.35 mm on two cores, and 0.5 s for
/// a canal's proposal that it changes; 2 s for a clicked canal. One thread at a time.
class JawFinder {
 public:
  /// Everything that does not depend on clicks.
  JawFinder(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield, const ReportStage& report = {},
            const ReportJaw& so_far = {});
  ~JawFinder();
  JawFinder(const JawFinder&) = delete;
  JawFinder& operator=(const JawFinder&) = delete;

  /// The same as segmentJaw() with these clicks, whatever was clicked before. Throws LoadError as that, and whatever
  /// `report` or `show` throws; the finder can be used again afterwards. `show`: called at most once.
  JawSegmentation withClicks(const JawClicks& clicks, const ReportStage& report = {}, const ShowTeeth& show = {},
                             const ReportJaw& so_far = {});

  /// What canals of a side are drawn in with those clicks, in cells of about 0.7 mm (canal_search.h); empty where
  /// nothing was found. 0.3 s at 0.35 mm.
  HalfJaw halfOf(bool is_right) const;

 private:
  struct Jaw;
  struct Teeth;
  struct Canal;
  VolumeGrid scan_;
  std::optional<JawRefusal> refusal_;
  std::unique_ptr<Jaw> jaw_;       ///< none: refused
  std::unique_ptr<Teeth> teeth_;   ///< of the last clicks
  std::unique_ptr<Canal> canals_;  ///< of the last clicks, by side
};

/// Smaller scans are parts of a jaw in which no row of teeth can be told.
inline constexpr double kLeastJaw_mm = 35.0;
bool canHoldJaw(const VolumeGrid& grid);

/// Throws LoadError of one line for clicks that do not fit what was found.
JawSegmentation segmentJaw(const VolumeGrid& grid, const std::vector<std::int16_t>& hounsfield,
                           const ReportStage& report = {}, const JawClicks& clicks = {}, const ReportJaw& so_far = {});

}  // namespace assets

// A found jaw with a person's strokes and cuts on it. Follows a list of edits: what it no longer holds is taken back
// from what was kept (assets/segment/label_changes.h, 64 MB at most, the oldest forgotten first), what it holds anew is
// applied. A stroke under the hand is shown dab by dab. Frame P, mm. Main thread; a dab of 1.5 mm 0.1 ms at 0.35 mm.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/segment/label_changes.h"

namespace app {

class PaintedJaw {
 public:
  static constexpr std::size_t kMostKept_bytes = std::size_t{64} << 20;
  /// What a voxel has become.
  using Shown = std::function<void(const glm::ivec3& ijk, assets::VoxelLabel now)>;

  /// `ct` must outlive it.
  PaintedJaw(const assets::CtVolume& ct, assets::JawSegmentation stored, std::size_t most_bytes = kMostKept_bytes);

  /// Found anew: nothing is painted on it.
  void take(assets::JawSegmentation found);
  /// False: an edit that is not kept would have to be taken back; the jaw is to be found anew.
  bool follow(const std::vector<assets::VoxelEdit>& edits, const Shown& shown);

  /// It was found, not read: it can be painted.
  bool isFound() const { return !jaw_.label.empty(); }
  const assets::JawSegmentation& jaw() const { return jaw_; }
  std::size_t keptBytes() const;

  /// Points from `first` on are new.
  void dab(const assets::BrushStroke& stroke, std::size_t first, const Shown& shown);
  /// The stroke is whole, and one of the edits; or it is taken back.
  void endStroke(const assets::BrushStroke& stroke);
  void leaveStroke(const Shown& shown);

 private:
  struct Painted {
    assets::VoxelEdit edit;
    std::optional<assets::LabelChanges> changes;  ///< none: forgotten
  };
  void change(std::size_t v, const glm::ivec3& ijk, assets::VoxelLabel to, const Shown& shown);
  void paint(const assets::VoxelEdit& edit, std::size_t first, assets::LabelChanges& changes, const Shown& shown);
  void takeBack(const assets::LabelChanges& changes, const Shown& shown);
  void keepWithinBudget();
  void count();

  const assets::CtVolume& ct_;
  assets::JawSegmentation jaw_;
  std::size_t most_bytes_ = kMostKept_bytes;
  std::vector<assets::FoundTooth> found_teeth_;  ///< without strokes
  assets::ToothCounts counts_;
  std::deque<Painted> painted_;
  std::optional<assets::LabelChanges> stroke_;
};

}  // namespace app

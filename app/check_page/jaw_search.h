// Looks for the jaw of a scan, and for what a person's clicks make of it, on a thread of its own: the page stays
// responsive, says which stage is worked on, and can leave work that is not wanted any more at once; the thread itself
// ends it at the next stage. One owner's thread.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/ct_volume.h"
#include "assets/segment/jaw_segmentation.h"

namespace app {

class JawSearch {
 public:
  struct Answer {
    assets::JawClicks clicks;     ///< of which question
    assets::JawSegmentation jaw;  ///< with a refusal of its own, or not at all:
    /// Right and left, where canals are drawn; none: as those of the answer before.
    std::optional<std::array<assets::HalfJaw, 2>> halves{};
    std::string refusal;   ///< one line; empty: found
    bool is_whole = true;  ///< false: teeth; canals that they change follow
  };

  /// Begins at once; `ct` must outlive it.
  explicit JawSearch(const assets::CtVolume& ct);
  /// Waits for the stage that is worked on.
  ~JawSearch();
  JawSearch(const JawSearch&) = delete;
  JawSearch& operator=(const JawSearch&) = delete;

  /// Takes the place of an earlier question.
  void ask(assets::JawClicks clicks);
  void leaveIt();

  bool isBusy() const;
  /// "right canal"; empty when it is not busy.
  std::string stage() const;
  double seconds() const;  ///< since it was asked
  /// The answer to the last question, once.
  std::optional<Answer> take();
  /// Waits for it; none if nothing was asked.
  std::optional<Answer> wait();

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace app

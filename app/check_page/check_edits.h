// What a person did on the check page, in order: clicks on teeth and canals, strokes of a brush and cuts
// (assets/segment/jaw_clicks.h), and words on canals. Undone and redone one by one, all of them. As text it is kept
// beside the patient while it is not saved, so that a kill loses nothing. Frame P, mm. Plain values; any one thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/options/jaw_clicks_file.h"
#include "assets/segment/jaw_clicks.h"

namespace app {

/// A canal through these points, from one end to the other; it takes the place of an earlier one of its side.
struct CanalClicks {
  bool is_right = true;
  std::vector<glm::dvec3> at_P_mm;
  friend bool operator==(const CanalClicks&, const CanalClicks&) = default;
};
/// Of a canal as it was shown: it holds as long as it has that length.
struct CanalWord {
  bool is_right = true, is_good = true;
  double length_mm = 0.0;
  friend bool operator==(const CanalWord&, const CanalWord&) = default;
};
using CheckEdit = std::variant<assets::ToothClick, CanalClicks, CanalWord, assets::BrushStroke, assets::JawCut>;

class CheckEdits {
 public:
  /// As many as a file of clicks may hold.
  static constexpr std::size_t kMost = kMostClicks;

  CheckEdits() = default;
  explicit CheckEdits(const assets::JawClicks& clicks, double middle_x_P_mm);

  /// Forgets what was undone. False: there are kMost.
  bool add(CheckEdit edit);
  bool undo();
  bool redo();
  /// Takes back the last one for good: it did not fit.
  void drop();

  std::size_t done() const { return done_; }
  std::size_t undone() const { return edits_.size() - done_; }
  /// The last one in force; null: none.
  const CheckEdit* last() const { return done_ == 0 ? nullptr : &edits_[done_ - 1]; }
  const std::vector<CheckEdit>& all() const { return edits_; }
  /// The last one in force is a stroke or a cut.
  bool lastIsPainted() const {
    return last() != nullptr &&
           (std::holds_alternative<assets::BrushStroke>(*last()) || std::holds_alternative<assets::JawCut>(*last()));
  }

  /// In force.
  assets::JawClicks clicks() const;
  /// The canal that was clicked on a side; null: none.
  const CanalClicks* canalOn(bool is_right) const;
  /// In force for a canal of that length.
  std::optional<bool> wordOn(bool is_right, double length_mm) const;

  /// `is_saved`: the patient was made with those in force.
  std::string text(bool is_saved = false) const;
  /// Of what fromText() read.
  bool wasSaved() const { return was_saved_; }
  /// Those in force alone.
  CheckEdits inForce() const;
  /// What is in force is the same.
  bool isLike(const CheckEdits& other) const;
  /// Throws UsageError of one line; `name` stands for the file.
  static CheckEdits fromText(const std::string& text, const std::string& name);

 private:
  std::vector<CheckEdit> edits_;
  std::size_t done_ = 0;
  bool was_saved_ = false;
};

/// Canal points with one more where it lengthens the way least.
std::vector<glm::dvec3> withPoint(std::vector<glm::dvec3> line, const glm::dvec3& point);
/// Its place among them.
std::size_t placeInWay(const std::vector<glm::dvec3>& line, const glm::dvec3& point);

}  // namespace app

// A point of a canal under the hand, with the canal tool: taken hold of in a picture, or made where the line is
// pressed, moved, and let go; then the canal through its points is one edit. The line follows while it is moved, in the
// cells of half a jaw. Of a canal that nobody has clicked the ends are its points. Frame P, mm. Main thread; 30 ms a
// move.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "app/check_page/check_menu.h"
#include "app/check_page/check_page.h"
#include "assets/segment/canal_search.h"

namespace app {

class HeldCanal {
 public:
  /// `in_view`: pixel of a view and distance from its slice, mm, of a point; not finite: not in it.
  using InView = std::function<glm::dvec3(const glm::dvec3& p_P_mm)>;

  explicit HeldCanal(CheckMenu& menu) : menu_(menu) {}
  void take(std::array<assets::HalfJaw, 2> halves) { halves_ = std::move(halves); }

  /// By side, right first; empty without a canal.
  std::array<std::vector<glm::dvec3>, 2> points(const std::vector<assets::CanalProposal>& canals) const;

  bool isHeld() const { return held_.has_value(); }
  /// False: there is neither point nor line.
  bool press(const std::vector<assets::CanalProposal>& canals, const glm::dvec2& at_px, const InView& in_view);
  /// `p_P_mm`: under the hand, in the slice; the point keeps its distance from it.
  void moveTo(const glm::dvec3& p_P_mm, const glm::dvec3& normal_P);
  /// Pressed and let go at one place it is a click there: an end of a canal that is begun, unless the point was clicked
  /// before. True: an edit was made of it.
  bool release();
  /// The end of a canal that nobody has clicked, as it is drawn there.
  std::optional<glm::dvec3> proposedEndAt(const std::vector<assets::CanalProposal>& canals, const glm::dvec2& at_px,
                                          const InView& in_view) const;
  void leave() { held_.reset(); }
  /// The point under the hand goes. False: there is none.
  bool removeAt(const std::vector<assets::CanalProposal>& canals, const glm::dvec2& at_px, const InView& in_view);

  /// As it would lead now.
  const std::vector<glm::dvec3>& line_P_mm() const { return line_P_mm_; }

 private:
  struct Held {
    bool is_right = true;
    std::vector<glm::dvec3> points_P_mm;
    std::size_t which = 0;
    double off_mm = 0.0;  ///< from the slice
    bool is_moved = false, is_clicked = false;
  };
  std::optional<Held> pointAt(const std::vector<assets::CanalProposal>& canals, const glm::dvec2& at_px,
                              const InView& in_view) const;

  CheckMenu& menu_;
  std::array<assets::HalfJaw, 2> halves_;
  std::optional<Held> held_;
  std::vector<glm::dvec3> line_P_mm_;
};

}  // namespace app

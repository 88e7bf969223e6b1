// The check page as a picture, and what lies at a pixel of it: one layout for drawing and clicking. Five views, the
// list of what was found with its lights, tools, a line of words. Any one thread. Cost: 60 ms at 1280 x 800 on two
// cores where everything is new; views that did not change are kept.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/check_page/check_menu.h"
#include "app/check_page/jaw_views.h"

namespace app {

struct ViewPlace {
  JawView view = JawView::axial;
  glm::dvec2 at_px{0.0};  ///< in the view
};
struct RowPlace {
  std::size_t row = 0;
};
using CheckPlace = std::variant<ViewPlace, RowPlace, CheckTool, CheckAction>;

/// What lies under the hand, besides the cursor.
struct CheckHand {
  std::optional<ViewPlace> brush{};                   ///< where its circle is
  std::vector<std::vector<glm::dvec3>> canal_points;  ///< to be taken hold of
  std::vector<glm::dvec3> drawn_P_mm;                 ///< the canal as it would lead now
};

/// What is worked on; empty: nothing.
struct CheckProgress {
  std::string stage;
  double seconds = 0.0;
};

class CheckPage {
 public:
  /// `views` must outlive it.
  explicit CheckPage(const JawViews& views) : views_(views) {}

  std::optional<CheckPlace> placeAt(const CheckMenu& menu, const glm::dvec2& at_px, glm::ivec2 window_px) const;
  glm::ivec2 sizeOf(JawView view, glm::ivec2 window_px) const;
  glm::dvec2 cornerOf(JawView view, glm::ivec2 window_px) const;

  /// Teeth were taken into the views.
  void forget() { ++version_, ++slice_version_; }
  /// Voxels were: until forget() in the slices alone.
  void forgetSlices() { ++slice_version_; }
  SolidLook look{};
  GreyRange range{};

  /// `canals`: of what was found.
  render::Image picture(const CheckMenu& menu, const std::vector<assets::CanalProposal>& canals,
                        const std::string& title, const CheckProgress& progress, const CheckHand& hand,
                        glm::ivec2 window_px);

 private:
  const render::Image& viewPicture(JawView view, const CheckMenu& menu, glm::ivec2 px);

  struct Kept {
    std::string key;
    render::Image image;
  };
  const JawViews& views_;
  std::array<Kept, kJawViews> kept_;
  int version_ = 0, slice_version_ = 0;
};

}  // namespace app

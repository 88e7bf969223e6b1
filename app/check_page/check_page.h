// The check page as a picture, and what lies at a pixel of it: one layout for drawing and clicking. Five views, the
// list of what was found with its lights, tools, a line of words. Only what differs from the picture before is drawn
// again; of a view whose voxels changed, the pixels that show them. Main thread. Cost at 1280 x 800 on two cores: 60 ms
// where everything is new, 3 ms where a brush moved.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/check_page/check_menu.h"
#include "app/check_page/drawn_key.h"
#include "app/check_page/jaw_views.h"
#include "app/check_page/page_layout.h"
#include "app/check_page/view_marks.h"
#include "app/report/drawing.h"

namespace app {

struct RowPlace {
  std::size_t row = 0;
};
using CheckPlace = std::variant<ViewPlace, RowPlace, CheckTool, CheckAction>;

/// What is worked on; empty: nothing.
struct CheckProgress {
  std::string stage;
  double seconds = 0.0;
  bool may_stop = true;
};

class CheckPage {
 public:
  /// `views` must outlive it.
  explicit CheckPage(const JawViews& views) : views_(views) {}

  std::optional<CheckPlace> placeAt(const CheckMenu& menu, const glm::dvec2& at_px, glm::ivec2 window_px) const;
  glm::ivec2 sizeOf(JawView view, glm::ivec2 window_px) const;
  glm::dvec2 cornerOf(JawView view, glm::ivec2 window_px) const;

  /// Voxels in the box were taken into the views. `still_drawn`: by a stroke that goes on; until the next change that
  /// is none the slices alone show it.
  void changed(const assets::CellBox& voxels, bool still_drawn = false);
  SolidLook look{};
  GreyRange range{};

  /// `canals`: of what was found. The page's own, until it draws again.
  const render::Image& picture(const CheckMenu& menu, const std::vector<assets::CanalProposal>& canals,
                               const std::string& title, const CheckProgress& progress, const CheckHand& hand,
                               glm::ivec2 window_px);

 private:
  struct KeptView {
    std::optional<DrawnKey> key, marks, words_of;  ///< of image, marks and words
    render::Image image;
    std::unique_ptr<Drawing> words;
    assets::CellBox changed;  ///< since it was drawn
  };

  bool refresh(JawView view, const CheckMenu& menu, glm::ivec2 px);
  void drawView(const MarkedView& marked, bool is_new);
  void begin(glm::ivec2 window_px);
  /// Draws a part again if its key is another.
  template <class Draw>
  void drawPart(PagePart part, DrawnKey key, const Draw& draw);
  void show(const PageBox& box);

  const JawViews& views_;
  std::array<KeptView, kJawViews> kept_;
  std::array<std::optional<DrawnKey>, kPageParts> parts_;
  bool is_still_drawn_ = false;
  glm::ivec2 window_px_{0};
  std::unique_ptr<Drawing> page_;
  render::Image picture_;
};

}  // namespace app

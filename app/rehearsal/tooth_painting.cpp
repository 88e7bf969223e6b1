#include "app/rehearsal/tooth_painting.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace app {

void ToothPainting::layTogether(const render::Layers& layers) {
  has_deviation_ = layers.deviation, has_insertion_ = layers.insertion, has_marks_ = layers.marks;
  is_painted_ = false;
  ++serial_;
  std::vector<const PaintSpots*> spots;
  std::vector<render::SurfacePaint::Row> rows;
  const char* title = nullptr;
  const auto lay = [&](const PaintSpots& of, std::vector<render::SurfacePaint::Row> means, const char* named) {
    if (means.empty()) return;
    spots.push_back(&of);
    std::ranges::move(means, std::back_inserter(rows));
    if (title == nullptr) title = named;
  };
  if (outline_ != nullptr) lay(outline_->spots, outlineRows(), "practice block");
  if (has_deviation_ && measured_ != nullptr) lay(measured_->deviation, deviationRows(), "off the ideal");
  if (has_insertion_ && measured_ != nullptr) lay(measured_->undercut, insertionRows(*measured_), "insertion");
  if (has_marks_ && marked_ != nullptr) lay(marked_->spots, biteRows(marked_->bite), "bite");
  if (title == nullptr) return;
  const assets::VolumeGrid& box = marked_ != nullptr     ? marked_->box
                                  : measured_ != nullptr ? measured_->box
                                                         : outline_->box;
  paint_ = paintOf(volume_, box, spots);
  paint_.title = title;
  paint_.rows = std::move(rows);
  is_painted_ = true;
}

void ToothPainting::show(render::Frame& picture) {
  const render::Layers& layers = picture.layers;
  if (std::exchange(is_new_, false) || layers.deviation != has_deviation_ || layers.insertion != has_insertion_ ||
      layers.marks != has_marks_)
    layTogether(layers);
  picture.paint = is_painted_ ? &paint_ : nullptr;
  picture.paint_serial = serial_;
  picture.arrow = has_insertion_ && measured_ != nullptr ? measured_->arrow : std::nullopt;
}

}  // namespace app

// What is painted on the live tooth of a preparation, as the layers of the picture ask: the distance to its ideal, the
// way of insertion with what hinders it, marks of articulating paper. Laid together when a measure or a layer has
// changed (some 5 ms), lent to each frame. Main thread.
#pragma once

#include <cstdint>

#include "app/procedure/preparation/bite_watch.h"
#include "app/procedure/preparation/preparation_paint.h"
#include "assets/volume_grid.h"
#include "render/frame.h"
#include "render/volume/surface_paint.h"

namespace app {

class ToothPainting {
 public:
  /// `volume`: that the renderer draws.
  explicit ToothPainting(const assets::VolumeGrid& volume) : volume_(volume) {}
  /// With an outline under everything else, whatever layers are shown; borrowed.
  ToothPainting(const assets::VolumeGrid& volume, const DrawnOutline& outline)
      : volume_(volume), outline_(outline.spots.empty() ? nullptr : &outline), is_new_(outline_ != nullptr) {}
  ToothPainting(const ToothPainting&) = delete;
  ToothPainting& operator=(const ToothPainting&) = delete;

  /// Anew; borrowed until the next one.
  void take(const PreparationPaint& measured) {
    measured_ = &measured;
    is_new_ = true;
  }
  /// Alike.
  void take(const BittenTooth::Marked& marked) {
    marked_ = &marked;
    is_new_ = true;
  }
  /// Once a frame: paint and arrow of the picture, lent to it until the next call.
  void show(render::Frame& picture);

 private:
  void layTogether(const render::Layers& layers);

  assets::VolumeGrid volume_;
  const DrawnOutline* outline_ = nullptr;
  const PreparationPaint* measured_ = nullptr;
  const BittenTooth::Marked* marked_ = nullptr;
  bool is_new_ = false;
  bool has_deviation_ = false, has_insertion_ = false, has_marks_ = true;  ///< in the paint
  render::SurfacePaint paint_;
  bool is_painted_ = false;
  std::uint64_t serial_ = 0;
};

}  // namespace app

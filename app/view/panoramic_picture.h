// The panoramic view as a picture: grey values of a bone window, the walls of the mandibular canal, the bur, sides and
// a scale. Drawn in the instructor's window and by `molar see --panoramic`. One thread at a time. Cost: the reformat
// once (assets/scan/panoramic.h), then some milliseconds a picture.
#pragma once

#include <optional>

#include "assets/patient.h"
#include "assets/scan/panoramic.h"
#include "render/image.h"

namespace app {

class PanoramicPicture {
 public:
  /// None if the patient has neither numbered teeth nor an operated one.
  static std::optional<PanoramicPicture> of(const assets::Patient& patient);

  /// `zoom` output pixels per pixel of the reformat. `bur_P_mm`: none is not drawn.
  render::Image image(double zoom, const std::optional<glm::dvec3>& bur_P_mm = {}) const;
  glm::ivec2 size_px(double zoom) const { return glm::ivec2(zoom * glm::dvec2(view_.size_px)); }

 private:
  PanoramicPicture(const assets::Patient& patient, assets::Panoramic view);

  assets::Panoramic view_;
  render::Image grey_;
  std::vector<glm::dvec2> canal_px_;  ///< centre line in the reformat; not finite where it is interrupted
  double canal_radius_mm_ = 0.0;
};

}  // namespace app

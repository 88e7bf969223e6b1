// Antialiasing of silhouettes: marks edge pixels by the image's distances (edge_mask.frag), lets the scene be drawn
// again with 2x2 samples in those pixels only, and writes their means back. All other pixels keep their bits. Render
// thread. Cost: three passes without rays, plus the rays and triangles of the edges.
#pragma once

#include "render/gpu/framebuffer.h"
#include "render/gpu/program.h"

namespace render {

class EdgePass {
 public:
  /// Marks the edges of an image whose distances are drawn; in a mirror's glass those of the reflected view, bound to
  /// REFLECTED_DISTANCE_UNIT.
  void find(const Framebuffer& image);
  /// After find(): rejects by depth all but the edges in the cleared `samples`, 2x2 samples to a pixel.
  void rejectInterior(const Framebuffer& samples);
  /// After drawing the scene into `samples`: writes their means to the edge pixels of the image.
  void average(const Framebuffer& samples, const Framebuffer& image);

 private:
  Framebuffer mask_;
  Program find_{"screen.vert", "edge_mask.frag"}, reject_{"screen.vert", "edge_reject.frag"},
      average_{"screen.vert", "edge_mean.frag"};
};

}  // namespace render

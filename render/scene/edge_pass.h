// Antialiasing where it shows: finds the pixels at silhouettes by the image's distances (edge_rule.glsl), lets the
// scene be drawn again with 2x2 samples there and nowhere else, and gives those pixels the mean as the display shows
// it. All other pixels stay as they are, bit for bit. Render thread. Cost: three passes without rays, and the rays and
// triangles of the edges (render/README.md).
#pragma once

#include "render/gpu/framebuffer.h"
#include "render/gpu/program.h"

namespace render {

class EdgePass {
 public:
  /// Of a image whose distances are drawn.
  void find(const Framebuffer& image);
  /// After find(): bars everything but the edges in the cleared `samples`, 2x2 samples to a pixel.
  void rejectInterior(const Framebuffer& samples);
  /// Once the scene is drawn into `samples`: brings their means to the image.
  void average(const Framebuffer& samples, const Framebuffer& image);

 private:
  Framebuffer mask_;
  Program find_{"screen.vert", "edge_mask.frag"}, reject_{"screen.vert", "edge_reject.frag"},
      average_{"screen.vert", "edge_mean.frag"};
};

}  // namespace render

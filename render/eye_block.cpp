#include "render/eye_block.h"

#include <numbers>

namespace render {
namespace {

using calibration::Patient;
using calibration::Point;
using calibration::Vector;
using calibration::World;

// OpenGL's -1..1 depth to reverse-Z, 1 at the near plane and 0 far away: z' = (w - z) / 2.
glm::dmat4 reverseZ() {
  glm::dmat4 m(1.0);
  m[2][2] = -0.5;
  m[3][2] = 0.5;
  return m;
}

glm::vec4 packed(const glm::dvec3& xyz, double w = 0.0) { return {glm::vec3(xyz), static_cast<float>(w)}; }

// Factor of the squared distance in exp2() of the cover.
double perSquareReach(double reach_mm) { return reach_mm > 0.0 ? std::numbers::log2e / (reach_mm * reach_mm) : 0.0; }

}  // namespace

EyeBlock eyeBlock(const Frame& frame, const EyeView& view) {
  const calibration::Pose<Patient, World> X_PW = frame.rig.X_WP.inverse();

  // The lamp is a little nearer than the head is to the middle of the virtual screen.
  const Point<World> middle_W = view.lower_left_W + 0.5 * view.right_edge_W + 0.5 * view.up_edge_W;
  const Point<World> head_W = frame.rig.cyclopeanEye();
  const double reach_mm = glm::length((head_W - middle_W).xyz);
  const Point<World> lamp_W = head_W + reach_mm * Vector<World>{{0.45, 0.70, 0.05}};
  const Vector<World> beam_W = middle_W - lamp_W;
  const double beam_mm = glm::length(beam_W.xyz);

  return {.clip_from_P = glm::mat4(reverseZ() * view.clip_from_W * frame.rig.X_WP.matrix()),
          .eye_P = packed((X_PW * view.eye_W).mm),
          .lower_left_P = packed((X_PW * view.lower_left_W).mm),
          .right_edge_P = packed((X_PW * view.right_edge_W).xyz),
          .up_edge_P = packed((X_PW * view.up_edge_W).xyz),
          .lamp_P = packed((X_PW * lamp_W).mm, beam_mm),
          .lamp_axis_P = packed((X_PW * beam_W).xyz / beam_mm),
          .up_P = packed((X_PW * Vector<World>{{0.0, 1.0, 0.0}}).xyz),
          .window_eye_P = packed((X_PW * head_W).mm),
          .window_site_P = packed(frame.site_P.mm, frame.face_window_mm),
          .field_P = packed(frame.field.centre_P.mm, perSquareReach(frame.field.reach_mm)),
          .field_cover = {frame.field.water, frame.field.blood, frame.field.dust, frame.field.spray}};
}

}  // namespace render

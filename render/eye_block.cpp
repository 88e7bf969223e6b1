#include "render/eye_block.h"

#include <algorithm>
#include <cmath>
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

// Of the glass itself nothing is seen in it.
constexpr double kOffGlass_mm = 0.05;

struct Glass {
  Point<World> centre_W;
  glm::dvec3 out_W{0.0, 0.0, 1.0};
};

// Where the eye is in front of it.
std::optional<Glass> glassBefore(const Frame& frame, const Point<World>& eye_W) {
  if (!frame.second_visible || !frame.second_glass) return {};
  const auto X_WO = frame.rig.X_WP * frame.X_PO;
  const Glass glass{{X_WO.translation_mm}, X_WO.rotation * frame.second_glass->out_O};
  if (!(glm::dot(eye_W.mm - glass.centre_W.mm, glass.out_W) > kOffGlass_mm)) return {};
  return glass;
}

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
          .field_cover = {frame.field.water, frame.field.blood, frame.field.dust, frame.field.spray},
          .begin_P = glm::vec4(0.0f),
          .glass = {glassBefore(frame, view.eye_W) ? 1.0f : 0.0f,
                    frame.second_glass ? static_cast<float>(frame.second_glass->fog) : 0.0f, 0.0f, 0.0f},
          .curing_P = frame.curing ? packed(frame.curing->tip_P.mm, frame.curing->reach_mm) : glm::vec4(0.0f),
          .curing_axis_P = frame.curing ? packed(frame.curing->axis_P, frame.curing->radius_mm) : glm::vec4(0.0f)};
}

std::optional<EyeBlock> reflectedEyeBlock(const Frame& frame, const EyeView& view) {
  const std::optional<Glass> glass = glassBefore(frame, view.eye_W);
  if (!glass) return {};
  const double offset_mm = glm::dot(glass->out_W, glass->centre_W.mm);
  const EyeView there = reflected(view, {glass->out_W, offset_mm}, kOffGlass_mm);

  // Lamp and window stay where they are; the rays begin at the glass.
  const calibration::Pose<Patient, World> X_PW = frame.rig.X_WP.inverse();
  EyeBlock block = eyeBlock(frame, view);
  block.clip_from_P = glm::mat4(reverseZ() * there.clip_from_W * frame.rig.X_WP.matrix());
  block.eye_P = packed((X_PW * there.eye_W).mm);
  block.lower_left_P = packed((X_PW * there.lower_left_W).mm);
  block.right_edge_P = packed((X_PW * there.right_edge_W).xyz);
  block.up_edge_P = packed((X_PW * there.up_edge_W).xyz);
  block.begin_P =
      packed(X_PW.rotation * glass->out_W, kOffGlass_mm + glm::dot(view.eye_W.mm - glass->centre_W.mm, glass->out_W));
  block.glass = glm::vec4(0.0f);
  return block;
}

GlassBox glassBox(const Frame& frame, const EyeView& view, glm::ivec2 px) {
  const std::optional<Glass> glass = glassBefore(frame, view.eye_W);
  if (!glass) return {};
  // A square around the disc.
  const glm::dvec3& n = glass->out_W;
  const glm::dvec3 x = glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 y = glm::cross(n, x);
  const double radius_mm = frame.second_glass->radius_mm;
  glm::dvec2 low(1.0), high(-1.0);
  for (const double i : {-radius_mm, radius_mm})
    for (const double j : {-radius_mm, radius_mm}) {
      const glm::dvec4 clip = view.clip_from_W * glm::dvec4(glass->centre_W.mm + i * x + j * y, 1.0);
      // Beside the eye: anywhere.
      if (!(clip.w > 1.0)) return {glm::ivec2(0), px};
      const glm::dvec2 at = glm::clamp(glm::dvec2(clip) / clip.w, -1.0, 1.0);
      low = glm::min(low, at), high = glm::max(high, at);
    }
  const glm::ivec2 first(glm::floor((0.5 + 0.5 * low) * glm::dvec2(px))),
      end(glm::ceil((0.5 + 0.5 * high) * glm::dvec2(px)));
  if (end.x <= first.x || end.y <= first.y) return {};
  return {first, end - first};
}

}  // namespace render

#include "render/cpu/mesh_bodies.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "render/gpu/gpu_error.h"

namespace render {
namespace {

bool isOverlay(Model model) {
  return model == Model::mandibular_canal_overlay || model == Model::ruler_overlay || model == Model::arrow_overlay ||
         model == Model::ghost || model == Model::obstacles;
}
bool isSeenFromOutside(Model model) { return finishOf(model) == Finish::guide || finishOf(model) == Finish::obstacle; }
bool isInHand(Model model) { return model == Model::instrument || model == Model::second_instrument; }
bool isMoving(Model model) { return isInHand(model) || model >= Model::beads; }

MeshBodyPart keptPart(const assets::MeshPart& part, Model model) {
  MeshBodyPart kept;
  kept.material = part.material;
  kept.finish = finishOf(model, part.name);
  kept.is_cut = isCutByWindow(model, part);
  kept.normals.assign(part.position_mm.size(), glm::vec4(0.0f, 0.0f, 1.0f, 0.0f));
  for (std::size_t c = 0; c < std::min(kept.normals.size(), part.normal.size()); ++c)
    kept.normals[c] = glm::vec4(part.normal[c], 0.0f);
  kept.colours = part.colour;
  if (!kept.colours.empty()) kept.colours.resize(part.position_mm.size(), glm::vec4(1.0f));
  for (std::size_t i = 0; i + 2 < part.triangles.size(); i += 3)
    kept.triangles.emplace_back(part.triangles[i], part.triangles[i + 1], part.triangles[i + 2]);
  return kept;
}

}  // namespace

MeshBodies::MeshBodies() : device_(rtcNewDevice(nullptr)) {
  if (device_ == nullptr)
    throw GpuError(
        "no ray tracing of meshes, Embree: this processor or its memory is not sufficient; use --renderer gl");
  for (RTCScene& scene : scenes_) {
    scene = rtcNewScene(device_);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
    rtcCommitScene(scene);
  }
  throwIfFailed();
}

MeshBodies::~MeshBodies() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) remove(i);
  for (RTCScene scene : scenes_) rtcReleaseScene(scene);
  rtcReleaseDevice(device_);
}

void MeshBodies::throwIfFailed() const {
  if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE)
    throw GpuError("meshes for the CPU, Embree: error " + std::to_string(error) +
                   (error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory; use a smaller model" : "; use --renderer gl"));
}

void MeshBodies::attach(std::size_t index, std::optional<MeshGroup> group) {
  MeshBody& body = bodies_[index];
  if (body.group == group) return;
  const auto is_static = [](std::optional<MeshGroup> of) { return of == MeshGroup::fixed || of == MeshGroup::veil; };
  if (is_static(body.group) || is_static(group)) ++static_revision_;
  if (body.group) rtcDetachGeometry(scene(*body.group), static_cast<unsigned>(index));
  if (group) rtcAttachGeometryByID(scene(*group), body.instance, static_cast<unsigned>(index));
  body.group = group;
}

void MeshBodies::setOccluder(std::size_t index, bool is_occluder) {
  MeshBody& body = bodies_[index];
  if (body.is_occluder == is_occluder) return;
  if (is_occluder)
    rtcAttachGeometryByID(scene(MeshGroup::occluders), body.instance, static_cast<unsigned>(index));
  else
    rtcDetachGeometry(scene(MeshGroup::occluders), static_cast<unsigned>(index));
  body.is_occluder = is_occluder;
}

void MeshBodies::move(MeshBody& body, const glm::dmat4& P_from_mesh) {
  const glm::mat4 pose(P_from_mesh);
  body.has_pose = true;
  body.P_from_mesh = glm::mat3(pose);
  body.pose = glm::mat4x3(pose);
  rtcSetGeometryTransform(body.instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &body.pose);
  rtcCommitGeometry(body.instance);
}

// A body keeps its slot, since the index is its instance ID; free slots are reused.
void MeshBodies::remove(std::size_t index) {
  MeshBody& body = bodies_[index];
  if (body.scene == nullptr) return;
  attach(index, std::nullopt);
  setOccluder(index, false);
  rtcReleaseGeometry(body.instance);
  rtcReleaseScene(body.scene);
  body = MeshBody{};
}

RTCScene MeshBodies::sceneOf(const std::vector<const assets::MeshPart*>& from, MeshBody& body) {
  RTCScene scene = rtcNewScene(device_);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  for (const assets::MeshPart* part : from) {
    RTCGeometry triangles = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const position = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), part->position_mm.size()));
    auto* const index = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), part->triangles.size() / 3));
    throwIfFailed();
    std::ranges::copy(part->position_mm, position);
    const MeshBodyPart& kept = body.parts.emplace_back(keptPart(*part, body.model));
    std::ranges::copy(kept.triangles, index);

    const MeshTrait trait = kept.is_cut                      ? MeshTrait::cuttable
                            : kept.finish == Finish::gingiva ? MeshTrait::torn
                            : isSeenFromOutside(body.model)  ? MeshTrait::outside_only
                                                             : MeshTrait::plain;
    rtcSetGeometryUserData(triangles, reinterpret_cast<void*>(trait));
    rtcCommitGeometry(triangles);
    rtcAttachGeometry(scene, triangles);
    rtcReleaseGeometry(triangles);
  }
  rtcCommitScene(scene);
  RTCBounds bounds;
  rtcGetSceneBounds(scene, &bounds);
  body.low = {bounds.lower_x, bounds.lower_y, bounds.lower_z};
  body.high = {bounds.upper_x, bounds.upper_y, bounds.upper_z};
  throwIfFailed();
  return scene;
}

void MeshBodies::setModel(Model model, const assets::MeshModel& mesh) {
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (bodies_[i].model == model) remove(i);

  // Parts with the same pose and visibility share a body.
  for (const bool is_bur : {false, true})
    for (const bool transparent : {false, true}) {
      std::vector<const assets::MeshPart*> alike;
      for (const assets::MeshPart& part : mesh.parts)
        if (!part.triangles.empty() && (part.name == "Bur") == is_bur &&
            (part.material.base_colour.a < 1.0f) == transparent)
          alike.push_back(&part);
      if (alike.empty()) continue;
      auto at = std::ranges::find_if(bodies_, [](const MeshBody& body) { return body.scene == nullptr; });
      if (at == bodies_.end()) at = bodies_.insert(at, MeshBody{});
      at->model = model;
      at->is_bur = is_bur;
      at->transparent = transparent;
      at->scene = sceneOf(alike, *at);
      at->instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(at->instance, at->scene);
      rtcSetGeometryTimeStepCount(at->instance, 1);
      rtcSetGeometryTransform(at->instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &at->pose);
      rtcCommitGeometry(at->instance);
    }
  place(placements_, window_, SoftBlock(soft_));
}

void MeshBodies::place(const Placements& placements, const FaceWindow& window, const SoftBlock& soft) {
  if (window != window_ || !haveSameCuts(soft, soft_)) ++static_revision_;
  window_ = window;
  soft_ = soft;
  placements_ = placements;
  has_ = {};
  const bool guided = hasGuides() || opacityOf(Model::ghost) > 0.0f || opacityOf(Model::obstacles) > 0.0f;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    MeshBody& body = bodies_[i];
    if (body.scene == nullptr) continue;
    const bool is_in_hand = isInHand(body.model), is_moving = isMoving(body.model);
    const Placement& at = placements_[body.model];
    const bool visible = at.opacity > 0.0f, is_transparent = body.transparent || at.opacity < 1.0f;
    const bool is_veil = is_transparent && isVeilWhenFaded(body.model, body.parts.front().material);
    const MeshGroup group = isOverlay(body.model) ? MeshGroup::overlay
                            : is_veil             ? MeshGroup::veil
                            : is_transparent      ? MeshGroup::transparent
                            : is_moving           ? MeshGroup::moving
                                                  : MeshGroup::fixed;
    attach(i, visible ? std::optional(group) : std::nullopt);
    setOccluder(i, guided && visible && !is_transparent && (is_in_hand || body.model == Model::face));
    if (visible) has_[static_cast<std::size_t>(group)] = true;

    if (!is_moving && body.model != Model::ghost) continue;
    const glm::dmat4 rotated = glm::rotate(glm::dmat4(1.0), at.bur_angle_rad, glm::dvec3(0.0, 0.0, 1.0));
    move(body, body.is_bur ? at.P_from_mesh * rotated : at.P_from_mesh);
  }
  for (RTCScene scene : scenes_) rtcCommitScene(scene);
  throwIfFailed();
}

}  // namespace render

#include "render/cpu/mesh_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <tuple>

#include "render/gpu/gpu_error.h"
#include "render/scene/finish.h"

namespace render {
namespace {

constexpr int kPacket = 8;

struct Part {
  std::vector<glm::vec4> normals, colours;  ///< of the corners; no colours: white
  std::vector<glm::uvec3> triangles;
  assets::Material material;
  bool is_cut = false;
};

/// Parts that move alike and are seen alike: one Embree scene and its instance.
struct Body {
  MeshScene::Model model = MeshScene::Model::face;
  bool turns = false, transparent = false;
  bool is_held = false;  ///< its pose is not the identity
  RTCBounds bounds{};    ///< in its own frame
  std::vector<Part> parts;
  RTCScene scene = nullptr;
  RTCGeometry instance = nullptr;
  RTCScene shown_in = nullptr;  ///< the upper scene that holds the instance now
  bool covers = false;          ///< … and `covers` too
  glm::mat3 P_from_mesh{1.0f};
  glm::mat4x3 pose{1.0f};
};

struct Layer {
  int ray;
  float distance_mm, u, v;
  unsigned body, part, triangle;
  bool faces_eye;
};

/// What the filter of a query is told.
struct Query {
  RTCIntersectContext context;  // first: Embree hands back its address
  const std::vector<Body>* bodies;
  const MeshPlacement* placement;
  std::vector<Layer>* layers;  ///< null: looking for the first hit
};

// mm from the rim of the window, negative inside: rimDistance of mesh.frag.
float rimDistance(const MeshPlacement& m, const glm::vec3& p) {
  const glm::vec3 line = m.window_site_P - m.window_eye_P;
  const float reach = glm::length(line);
  const glm::vec3 axis = line / reach;
  const glm::vec3 offset = p - m.window_eye_P;
  const float along = glm::dot(offset, axis);
  return std::max(glm::length(offset - along * axis) - m.window_mm, along - (reach - 2.0f));
}

// What a geometry tells the filter by its user data.
enum Trait : std::uintptr_t { plain = 0, cuttable = 1, outside_only = 2 };

// Embree asks before it takes a hit: the window lets rays through, a guide's inside too, layers are noted and passed.
void filter(const RTCFilterFunctionNArguments* args) {
  const Query& query = *reinterpret_cast<const Query*>(args->context);
  const auto trait = reinterpret_cast<std::uintptr_t>(args->geometryUserPtr);
  const bool may_cut = trait == cuttable && query.placement->window_mm > 0.0f, one_sided = trait == outside_only;
  if (!may_cut && !one_sided && query.layers == nullptr) return;
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] == 0) continue;
    const float t = RTCRayN_tfar(args->ray, n, i);
    const glm::vec3 direction(RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i),
                              RTCRayN_dir_z(args->ray, n, i));
    if (may_cut) {
      const glm::vec3 origin(RTCRayN_org_x(args->ray, n, i), RTCRayN_org_y(args->ray, n, i),
                             RTCRayN_org_z(args->ray, n, i));
      if (rimDistance(*query.placement, origin + t * direction) < 0.0f) {
        args->valid[i] = 0;
        continue;
      }
    }
    const glm::vec3 outward(RTCHitN_Ng_x(args->hit, n, i), RTCHitN_Ng_y(args->hit, n, i),
                            RTCHitN_Ng_z(args->hit, n, i));
    const bool faces_eye = glm::dot(outward, direction) < 0.0f;
    if (one_sided && !faces_eye) {
      args->valid[i] = 0;
      continue;
    }
    if (query.layers == nullptr) continue;
    query.layers->push_back({.ray = static_cast<int>(RTCRayN_id(args->ray, n, i)),
                             .distance_mm = t,
                             .u = RTCHitN_u(args->hit, n, i),
                             .v = RTCHitN_v(args->hit, n, i),
                             .body = RTCHitN_instID(args->hit, n, i, 0),
                             .part = RTCHitN_geomID(args->hit, n, i),
                             .triangle = RTCHitN_primID(args->hit, n, i),
                             .faces_eye = faces_eye});
    args->valid[i] = 0;
  }
}

Finish finishOf(MeshScene::Model model) {
  switch (model) {
    case MeshScene::Model::face:
      return Finish::skin;
    case MeshScene::Model::gum:
      return Finish::gum;
    case MeshScene::Model::canal:
    case MeshScene::Model::canal_through:
      return Finish::guide;
    case MeshScene::Model::instrument:
    case MeshScene::Model::ghost:
      break;
  }
  return Finish::instrument;
}

// Linear in barycentric coordinates on the triangle in space, which is what OpenGL's perspective-correct varyings are.
void add(MeshPoints& to, const Body& body, const Part& part, unsigned triangle, float u, float v, int ray, float t,
         bool faces_eye, float opacity) {
  const glm::uvec3 abc = part.triangles[triangle];
  const float w = 1.0f - u - v;
  const auto mixed = [&](const std::vector<glm::vec4>& of) { return w * of[abc.x] + u * of[abc.y] + v * of[abc.z]; };
  glm::vec3 normal(mixed(part.normals));
  if (body.is_held) normal = body.P_from_mesh * normal;
  glm::vec4 colour = part.material.base_colour;
  if (!part.colours.empty()) colour *= mixed(part.colours);
  const auto n = static_cast<std::size_t>(to.count++);
  to.ray[n] = ray;
  to.distance_mm[n] = t;
  to.nx[n] = normal.x, to.ny[n] = normal.y, to.nz[n] = normal.z;
  to.r[n] = colour.r, to.g[n] = colour.g, to.b[n] = colour.b, to.a[n] = opacity * colour.a;
  to.roughness[n] = part.material.roughness;
  to.metallic[n] = part.material.metallic;
  to.finish[n] = static_cast<std::int32_t>(finishOf(body.model));
  to.is_cut[n] = part.is_cut ? 1 : 0;
  to.faces_eye[n] = faces_eye ? 1 : 0;
}

// A packet of the batch from ray `first` on; `valid` becomes -1 where there is one.
void fill(RTCRayHit8& packet, int* valid, const RayBatch& rays, int first, const float* limit_mm) {
  for (int i = 0; i < kPacket; ++i) {
    const auto r = static_cast<std::size_t>(std::min(first + i, rays.count - 1));
    packet.ray.org_x[i] = rays.origin_P.x, packet.ray.org_y[i] = rays.origin_P.y, packet.ray.org_z[i] = rays.origin_P.z;
    packet.ray.dir_x[i] = rays.x[r], packet.ray.dir_y[i] = rays.y[r], packet.ray.dir_z[i] = rays.z[r];
    packet.ray.tnear[i] = rays.near_mm[r];
    packet.ray.tfar[i] = limit_mm != nullptr ? std::min(limit_mm[r], rays.far_mm[r]) : rays.far_mm[r];
    packet.ray.time[i] = 0.0f;
    packet.ray.mask[i] = ~0u;
    packet.ray.id[i] = static_cast<unsigned>(r);
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    valid[i] = first + i < rays.count ? -1 : 0;
  }
}

}  // namespace

struct MeshScene::Impl {
  Impl();
  ~Impl();

  void remove(Model model);
  RTCScene sceneOf(const std::vector<const assets::MeshPart*>& from, Body& body);
  void show(Body& body, unsigned index, RTCScene in);
  void cover(Body& body, unsigned index, bool covers_guides);
  /// Takes away the layers from `first` on that the face or the instrument hides.
  void dropCovered(const RayBatch& rays, std::vector<Layer>& layers, std::size_t first) const;
  Query queryFor(std::vector<Layer>* layers) const;
  /// False where no ray comes near the instrument; else the limits become those of the still hits, or zero for such
  /// rays.
  bool mayMeetMoving(const RayBatch& rays, float* limit_mm, const MeshHits& hits) const;
  void trace(RTCScene in, const RayBatch& rays, const float* limit_mm, MeshHits& hits) const;
  /// Of the whole model; 0: it is not shown.
  float opacityOf(const Body& body) const;
  void complain() const;

  RTCDevice device = nullptr;
  RTCScene still = nullptr, moving = nullptr, transparent = nullptr, through = nullptr;  ///< the upper scenes
  RTCScene covers = nullptr;  ///< once more what hides the guides that are seen through bone, while there are any
  std::vector<Body> bodies;
  MeshPlacement placement;
  bool has_still = false, has_moving = false, has_transparent = false, has_through = false;
  std::uint64_t still_revision = 0;
};

MeshScene::Impl::Impl() : device(rtcNewDevice(nullptr)) {
  if (device == nullptr)
    throw GpuError("no ray tracing of meshes, Embree: this processor or its memory will not do; use --renderer gl");
  for (RTCScene* scene : {&still, &moving, &transparent, &through, &covers}) {
    *scene = rtcNewScene(device);
    rtcSetSceneFlags(*scene, RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    rtcSetSceneBuildQuality(*scene, RTC_BUILD_QUALITY_LOW);
    rtcCommitScene(*scene);
  }
  complain();
}

MeshScene::Impl::~Impl() {
  for (const Model model :
       {Model::face, Model::gum, Model::instrument, Model::canal, Model::canal_through, Model::ghost})
    remove(model);
  rtcReleaseScene(still);
  rtcReleaseScene(moving);
  rtcReleaseScene(transparent);
  rtcReleaseScene(through);
  rtcReleaseScene(covers);
  rtcReleaseDevice(device);
}

void MeshScene::Impl::complain() const {
  if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
    throw GpuError("meshes for the CPU, Embree: error " + std::to_string(error) +
                   (error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory; use a smaller model" : "; use --renderer gl"));
}

void MeshScene::Impl::show(Body& body, unsigned index, RTCScene in) {
  if (body.shown_in == in) return;
  if (body.shown_in == still || in == still) ++still_revision;
  if (body.shown_in != nullptr) rtcDetachGeometry(body.shown_in, index);
  if (in != nullptr) rtcAttachGeometryByID(in, body.instance, index);
  body.shown_in = in;
}

void MeshScene::Impl::cover(Body& body, unsigned index, bool covers_guides) {
  if (body.covers == covers_guides) return;
  if (covers_guides)
    rtcAttachGeometryByID(covers, body.instance, index);
  else
    rtcDetachGeometry(covers, index);
  body.covers = covers_guides;
}

// Bodies keep their places in the list, which are their numbers in the upper scenes; an emptied one is used again.
void MeshScene::Impl::remove(Model model) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (body.model != model || body.scene == nullptr) continue;
    show(body, static_cast<unsigned>(i), nullptr);
    cover(body, static_cast<unsigned>(i), false);
    rtcReleaseGeometry(body.instance);
    rtcReleaseScene(body.scene);
    body = Body{};
  }
}

float MeshScene::Impl::opacityOf(const Body& body) const {
  switch (body.model) {
    case Model::face:
      return placement.face_opacity;
    case Model::gum:
      return placement.gum_visible ? 1.0f : 0.0f;
    case Model::instrument:
      return placement.tool_visible ? 1.0f : 0.0f;
    case Model::canal:
      return placement.canal_visible ? 1.0f : 0.0f;
    case Model::canal_through:
      return placement.canal_visible ? placement.canal_through_opacity : 0.0f;
    case Model::ghost:
      return placement.ghost_opacity;
  }
  return 0.0f;
}

RTCScene MeshScene::Impl::sceneOf(const std::vector<const assets::MeshPart*>& from, Body& body) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  for (const assets::MeshPart* part : from) {
    RTCGeometry triangles = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const place = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), part->position_mm.size()));
    auto* const index = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), part->triangles.size() / 3));
    complain();
    std::ranges::copy(part->position_mm, place);

    Part& kept = body.parts.emplace_back();
    kept.material = part->material;
    kept.is_cut = finishOf(body.model) == Finish::skin && part->material.metallic < 0.5f;
    kept.normals.assign(part->position_mm.size(), glm::vec4(0.0f, 0.0f, 1.0f, 0.0f));
    for (std::size_t c = 0; c < std::min(kept.normals.size(), part->normal.size()); ++c)
      kept.normals[c] = glm::vec4(part->normal[c], 0.0f);
    kept.colours = part->colour;
    if (!kept.colours.empty()) kept.colours.resize(part->position_mm.size(), glm::vec4(1.0f));
    for (std::size_t i = 0; i + 2 < part->triangles.size(); i += 3)
      kept.triangles.emplace_back(part->triangles[i], part->triangles[i + 1], part->triangles[i + 2]);
    std::ranges::copy(kept.triangles, index);

    const Trait trait = kept.is_cut ? cuttable : finishOf(body.model) == Finish::guide ? outside_only : plain;
    rtcSetGeometryUserData(triangles, reinterpret_cast<void*>(trait));
    rtcCommitGeometry(triangles);
    rtcAttachGeometry(scene, triangles);
    rtcReleaseGeometry(triangles);
  }
  rtcCommitScene(scene);
  rtcGetSceneBounds(scene, &body.bounds);
  complain();
  return scene;
}

Query MeshScene::Impl::queryFor(std::vector<Layer>* layers) const {
  Query query{.context = {}, .bodies = &bodies, .placement = &placement, .layers = layers};
  rtcInitIntersectContext(&query.context);
  query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  if (layers != nullptr || placement.window_mm > 0.0f || placement.canal_visible) query.context.filter = filter;
  return query;
}

MeshScene::MeshScene() : impl_(std::make_unique<Impl>()) {}
MeshScene::~MeshScene() = default;

void MeshScene::setModel(Model model, const assets::MeshModel& mesh) {
  Impl& m = *impl_;
  m.remove(model);

  // Parts that move and are seen alike share a body.
  for (const bool turns : {false, true})
    for (const bool transparent : {false, true}) {
      std::vector<const assets::MeshPart*> alike;
      for (const assets::MeshPart& part : mesh.parts)
        if (!part.triangles.empty() && (part.name == "Bur") == turns &&
            (part.material.base_colour.a < 1.0f) == transparent)
          alike.push_back(&part);
      if (alike.empty()) continue;
      auto at = std::ranges::find_if(m.bodies, [](const Body& body) { return body.scene == nullptr; });
      if (at == m.bodies.end()) at = m.bodies.insert(at, Body{});
      at->model = model;
      at->turns = turns;
      at->transparent = transparent;
      at->scene = m.sceneOf(alike, *at);
      at->instance = rtcNewGeometry(m.device, RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(at->instance, at->scene);
      rtcSetGeometryTimeStepCount(at->instance, 1);
      rtcSetGeometryTransform(at->instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &at->pose);
      rtcCommitGeometry(at->instance);
    }
  place(m.placement);
}

void MeshScene::place(const MeshPlacement& placement) {
  Impl& m = *impl_;
  const MeshPlacement& before = m.placement;
  if (placement.window_mm != before.window_mm || placement.window_eye_P != before.window_eye_P ||
      placement.window_site_P != before.window_site_P)
    ++m.still_revision;
  m.placement = placement;
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), placement.bur_angle_rad, glm::dvec3(0.0, 0.0, 1.0));
  const bool guided = placement.canal_visible || placement.ghost_opacity > 0.0f;
  m.has_still = m.has_moving = m.has_transparent = m.has_through = false;
  for (std::size_t i = 0; i < m.bodies.size(); ++i) {
    Body& body = m.bodies[i];
    if (body.scene == nullptr) continue;
    const bool is_through = body.model == Model::canal_through || body.model == Model::ghost;
    const bool is_tool = body.model == Model::instrument;
    const float opacity = m.opacityOf(body);
    const bool visible = opacity > 0.0f, is_clear = body.transparent || opacity < 1.0f;
    RTCScene in = is_through ? m.through : is_clear ? m.transparent : is_tool ? m.moving : m.still;
    m.show(body, static_cast<unsigned>(i), visible ? in : nullptr);
    m.cover(body, static_cast<unsigned>(i), guided && visible && !is_clear && (is_tool || body.model == Model::face));
    if (visible)
      (is_through ? m.has_through : is_clear ? m.has_transparent : is_tool ? m.has_moving : m.has_still) = true;
    if (!is_tool && body.model != Model::ghost) continue;
    const glm::dmat4& held = is_tool ? placement.P_from_tool : placement.P_from_hand;
    const glm::mat4 pose(body.turns ? held * turned : held);
    body.is_held = true;
    body.P_from_mesh = glm::mat3(pose);
    body.pose = glm::mat4x3(pose);
    rtcSetGeometryTransform(body.instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &body.pose);
    rtcCommitGeometry(body.instance);
  }
  rtcCommitScene(m.still);
  rtcCommitScene(m.moving);
  rtcCommitScene(m.transparent);
  rtcCommitScene(m.through);
  rtcCommitScene(m.covers);
  m.complain();
}

bool MeshScene::hasOpaque() const { return impl_->has_still || impl_->has_moving; }
std::uint64_t MeshScene::stillRevision() const { return impl_->still_revision; }
bool MeshScene::hasTransparent() const { return impl_->has_transparent || impl_->has_through; }

void MeshScene::firstHits(const RayBatch& rays, MeshHits& hits) const {
  stillHits(rays, hits);
  addMovingHits(rays, hits);
}

void MeshScene::stillHits(const RayBatch& rays, MeshHits& hits) const {
  std::fill_n(hits.distance_mm, rays.count, 0.0f);
  if (impl_->has_still) impl_->trace(impl_->still, rays, rays.far_mm, hits);
}

void MeshScene::addMovingHits(const RayBatch& rays, MeshHits& hits) const {
  if (!impl_->has_moving) return;
  alignas(64) float limit_mm[RayBatch::kMost];
  if (!impl_->mayMeetMoving(rays, limit_mm, hits)) return;
  impl_->trace(impl_->moving, rays, limit_mm, hits);
}

// Rays against the boxes of what moves, in its own frame, where they lie close around a long thin instrument.
bool MeshScene::Impl::mayMeetMoving(const RayBatch& rays, float* limit_mm, const MeshHits& hits) const {
  std::fill_n(limit_mm, rays.count, 0.0f);
  bool any = false;
  for (const Body& body : bodies) {
    if (body.scene == nullptr || body.shown_in != moving) continue;
    const glm::mat3 mesh_from_P = glm::transpose(body.P_from_mesh);
    const glm::vec3 from = mesh_from_P * (rays.origin_P - glm::vec3(body.pose[3]));
    const glm::vec3 low = glm::vec3(body.bounds.lower_x, body.bounds.lower_y, body.bounds.lower_z) - 0.01f - from;
    const glm::vec3 high = glm::vec3(body.bounds.upper_x, body.bounds.upper_y, body.bounds.upper_z) + 0.01f - from;
    for (int r = 0; r < rays.count; ++r) {
      const glm::vec3 d = mesh_from_P * glm::vec3(rays.x[r], rays.y[r], rays.z[r]);
      float near = 0.0f, far = 1e9f;
      for (int axis = 0; axis < 3; ++axis) {
        const float inverse = 1.0f / (std::abs(d[axis]) < 1e-9f ? 1e-9f : d[axis]);
        const float a = low[axis] * inverse, b = high[axis] * inverse;
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
      }
      if (near > far) continue;
      limit_mm[r] = hits.distance_mm[r] > 0.0f ? hits.distance_mm[r] : rays.far_mm[r];
      any = true;
    }
  }
  return any;
}

void MeshScene::Impl::dropCovered(const RayBatch& rays, std::vector<Layer>& layers, std::size_t first) const {
  if (layers.size() == first) return;
  static thread_local MeshHits cover_hits;
  alignas(64) float limit_mm[RayBatch::kMost];
  std::fill_n(limit_mm, rays.count, 0.0f);
  std::fill_n(cover_hits.distance_mm, rays.count, 0.0f);
  for (std::size_t n = first; n < layers.size(); ++n)
    limit_mm[layers[n].ray] = std::max(limit_mm[layers[n].ray], layers[n].distance_mm);
  trace(covers, rays, limit_mm, cover_hits);
  std::erase_if(layers, [&](const Layer& layer) {
    const bool is_guide = bodies[layer.body].shown_in == through;
    const float cover_mm = cover_hits.distance_mm[layer.ray];
    return is_guide && cover_mm > 0.0f && cover_mm < layer.distance_mm;
  });
}

// Writes what is met before the limits and leaves the rest as it is.
void MeshScene::Impl::trace(RTCScene in, const RayBatch& rays, const float* limit_mm, MeshHits& hits) const {
  Query query = queryFor(nullptr);
  alignas(32) RTCRayHit8 packet;
  alignas(32) int valid[kPacket];
  for (int first = 0; first < rays.count; first += kPacket) {
    const int last = std::min(first + kPacket, rays.count);
    if (std::all_of(limit_mm + first, limit_mm + last, [](float limit) { return limit <= 0.0f; })) continue;
    fill(packet, valid, rays, first, limit_mm);
    rtcIntersect8(valid, in, &query.context, &packet);
    for (int i = 0; i < kPacket && first + i < rays.count; ++i) {
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      const int r = first + i;
      hits.distance_mm[r] = packet.ray.tfar[i];
      hits.u[r] = packet.hit.u[i], hits.v[r] = packet.hit.v[i];
      hits.body[r] = packet.hit.instID[0][i];
      hits.part[r] = packet.hit.geomID[i];
      hits.triangle[r] = packet.hit.primID[i];
      const glm::vec3 outward =
          bodies[hits.body[r]].P_from_mesh * glm::vec3(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]);
      hits.faces_eye[r] = glm::dot(outward, glm::vec3(rays.x[r], rays.y[r], rays.z[r])) < 0.0f;
    }
  }
}

void MeshScene::addSeen(const RayBatch& rays, const MeshHits& hits, const float* seen_mm, MeshPoints& to) const {
  const Impl& m = *impl_;
  to.makeRoom(rays.count);
  for (int r = 0; r < rays.count; ++r) {
    if (hits.distance_mm[r] == 0.0f || seen_mm[r] < hits.distance_mm[r]) continue;
    const Body& body = m.bodies[hits.body[r]];
    add(to, body, body.parts[hits.part[r]], hits.triangle[r], hits.u[r], hits.v[r], r, hits.distance_mm[r],
        hits.faces_eye[r], 1.0f);
  }
}

void MeshScene::layers(const RayBatch& rays, const float* limit_mm, MeshPoints& to) const {
  const Impl& m = *impl_;
  static thread_local std::vector<Layer> met;
  met.clear();
  Query query = m.queryFor(&met);
  alignas(32) RTCRayHit8 packet;
  alignas(32) int valid[kPacket];
  const auto collect = [&](RTCScene in, const float* before_mm) {
    for (int first = 0; first < rays.count; first += kPacket) {
      fill(packet, valid, rays, first, before_mm);
      rtcIntersect8(valid, in, &query.context, &packet);
    }
  };
  if (m.has_transparent) collect(m.transparent, limit_mm);
  const std::size_t covered_from = met.size();
  if (m.has_through) collect(m.through, rays.far_mm);
  m.dropCovered(rays, met, covered_from);
  if (met.empty()) return;

  // Ray by ray from back to front; of two at one place the later in the models' order lies in front.
  std::ranges::sort(met, [](const Layer& a, const Layer& b) {
    return std::tuple(a.ray, -a.distance_mm, a.body, a.part, a.triangle) <
           std::tuple(b.ray, -b.distance_mm, b.body, b.part, b.triangle);
  });
  to.makeRoom(static_cast<int>(met.size()));
  for (const Layer& layer : met) {
    const Body& body = m.bodies[layer.body];
    add(to, body, body.parts[layer.part], layer.triangle, layer.u, layer.v, layer.ray, layer.distance_mm,
        layer.faces_eye, m.opacityOf(body));
  }
}

}  // namespace render

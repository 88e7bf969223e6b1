#include "render/cpu/mesh_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "render/shaders/light_constants.glsl"

namespace render {
namespace {

constexpr int kPacket = 8;

struct Layer {
  int ray;
  float distance_mm, u, v;
  unsigned body, part, triangle;
  bool faces_eye;
};

/// Context of a query, passed to the filter.
struct Query {
  RTCIntersectContext context;  // must be first: Embree passes its address
  const FaceWindow* window;
  const SoftBlock* soft;
  std::vector<Layer>* layers;  ///< null: looking for the first hit
};

// mm from the rim of the window, negative inside: rimDistance of mesh.frag.
float rimDistance(const FaceWindow& window, const glm::vec3& p) {
  const glm::vec3 line = window.site_P - window.eye_P;
  const float reach = glm::length(line);
  const glm::vec3 axis = line / reach;
  const glm::vec3 offset = p - window.eye_P;
  const float along = glm::dot(offset, axis);
  return std::max(glm::length(offset - along * axis) - window.radius_mm, along - (reach - RIM_BEHIND));
}

// Filter of Embree's hits: rejects hits in the face window and in cuts of soft tissue, and back faces of guides;
// records layers and continues.
void filter(const RTCFilterFunctionNArguments* args) {
  const Query& query = *reinterpret_cast<const Query*>(args->context);
  const auto trait = static_cast<MeshTrait>(reinterpret_cast<std::uintptr_t>(args->geometryUserPtr));
  const bool may_cut = trait == MeshTrait::cuttable && query.window->radius_mm > 0.0f;
  const bool may_tear = trait == MeshTrait::torn && query.soft->counts.x > 0;
  const bool one_sided = trait == MeshTrait::outside_only;
  if (!may_cut && !may_tear && !one_sided && query.layers == nullptr) return;
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] == 0) continue;
    const float t = RTCRayN_tfar(args->ray, n, i);
    const glm::vec3 direction(RTCRayN_dir_x(args->ray, n, i), RTCRayN_dir_y(args->ray, n, i),
                              RTCRayN_dir_z(args->ray, n, i));
    if (may_cut || may_tear) {
      const glm::vec3 origin(RTCRayN_org_x(args->ray, n, i), RTCRayN_org_y(args->ray, n, i),
                             RTCRayN_org_z(args->ray, n, i));
      const glm::vec3 p_P = origin + t * direction;
      if (may_cut ? rimDistance(*query.window, p_P) < 0.0f : cutDistance(*query.soft, p_P) < 0.0f) {
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

// Interpolation in barycentric coordinates, equal to OpenGL's perspective-correct varyings.
void add(MeshPoints& to, const RayBatch& rays, const MeshBody& body, const MeshBodyPart& part, unsigned triangle,
         float u, float v, int ray, float t, bool faces_eye, float opacity) {
  const glm::uvec3 abc = part.triangles[triangle];
  const float w = 1.0f - u - v;
  const auto mixed = [&](const std::vector<glm::vec4>& of) { return w * of[abc.x] + u * of[abc.y] + v * of[abc.z]; };
  glm::vec3 normal(mixed(part.normals));
  const auto n = static_cast<std::size_t>(to.count++);
  if (part.finish == Finish::piece) {
    // Its tissue is looked up where it was scanned.
    const auto r = static_cast<std::size_t>(ray);
    const glm::vec3 p_P = rays.origin_P + t * glm::vec3(rays.x[r], rays.y[r], rays.z[r]);
    const glm::vec3 p_Q = glm::transpose(body.P_from_mesh) * (p_P - glm::vec3(body.pose[3]));
    to.qx[n] = p_Q.x, to.qy[n] = p_Q.y, to.qz[n] = p_Q.z;
    to.mx[n] = normal.x, to.my[n] = normal.y, to.mz[n] = normal.z;
  }
  if (body.has_pose) normal = body.P_from_mesh * normal;
  glm::vec4 colour = part.material.base_colour;
  if (!part.colours.empty()) colour *= mixed(part.colours);
  to.ray[n] = ray;
  to.distance_mm[n] = t;
  to.nx[n] = normal.x, to.ny[n] = normal.y, to.nz[n] = normal.z;
  to.r[n] = colour.r, to.g[n] = colour.g, to.b[n] = colour.b, to.a[n] = opacity * colour.a;
  to.roughness[n] = part.material.roughness;
  to.metallic[n] = part.material.metallic;
  to.finish[n] = static_cast<std::int32_t>(part.finish);
  to.is_cut[n] = part.is_cut ? 1 : 0;
  to.faces_eye[n] = faces_eye ? 1 : 0;
}

// A packet of the batch from ray `first` on; `valid`: -1 for its rays, 0 for the rest.
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

Query queryFor(const MeshBodies& bodies, std::vector<Layer>* layers) {
  Query query{.context = {}, .window = &bodies.window(), .soft = &bodies.soft(), .layers = layers};
  rtcInitIntersectContext(&query.context);
  query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  if (layers != nullptr || bodies.window().radius_mm > 0.0f || bodies.soft().counts.x > 0 || bodies.hasGuides())
    query.context.filter = filter;
  return query;
}

// Writes the hits before the limits and leaves other entries unchanged.
void trace(const MeshBodies& bodies, RTCScene in, const RayBatch& rays, const float* limit_mm, MeshHits& hits) {
  Query query = queryFor(bodies, nullptr);
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
      const glm::vec3 outward = bodies.all()[hits.body[r]].P_from_mesh *
                                glm::vec3(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]);
      hits.faces_eye[r] = glm::dot(outward, glm::vec3(rays.x[r], rays.y[r], rays.z[r])) < 0.0f;
    }
  }
}

// False if no ray hits the bounding box of an instrument in its own frame, where it fits tightly; else sets the limits
// of the rays that do, and zero for others.
bool mayMeetDynamic(const MeshBodies& bodies, const RayBatch& rays, float* limit_mm, const MeshHits& hits) {
  std::fill_n(limit_mm, rays.count, 0.0f);
  bool any = false;
  for (const MeshBody& body : bodies.all()) {
    if (body.scene == nullptr || body.group != MeshGroup::moving) continue;
    const glm::mat3 mesh_from_P = glm::transpose(body.P_from_mesh);
    const glm::vec3 from = mesh_from_P * (rays.origin_P - glm::vec3(body.pose[3]));
    const glm::vec3 low = body.low - 0.01f - from;
    const glm::vec3 high = body.high + 0.01f - from;
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

// Removes the layers from `first` on that the face or an instrument hides, and guides that are not behind what is seen.
void removeOccluded(const MeshBodies& bodies, const RayBatch& rays, const float* seen_mm, std::vector<Layer>& layers,
                    std::size_t first) {
  const auto is_open = [&](const Layer& layer) {
    return finishOf(bodies.all()[layer.body].model) == Finish::guide &&
           layer.distance_mm < seen_mm[layer.ray] + GUIDE_HIDDEN_MM;
  };
  layers.erase(std::remove_if(layers.begin() + static_cast<std::ptrdiff_t>(first), layers.end(), is_open),
               layers.end());
  if (layers.size() == first) return;
  static thread_local MeshHits occluder_hits;
  alignas(64) float limit_mm[RayBatch::kMaxRays];
  std::fill_n(limit_mm, rays.count, 0.0f);
  std::fill_n(occluder_hits.distance_mm, rays.count, 0.0f);
  for (std::size_t n = first; n < layers.size(); ++n)
    limit_mm[layers[n].ray] = std::max(limit_mm[layers[n].ray], layers[n].distance_mm);
  trace(bodies, bodies.scene(MeshGroup::occluders), rays, limit_mm, occluder_hits);
  std::erase_if(layers, [&](const Layer& layer) {
    const bool is_guide = bodies.all()[layer.body].group == MeshGroup::overlay;
    const float occluder_mm = occluder_hits.distance_mm[layer.ray];
    return is_guide && occluder_mm > 0.0f && occluder_mm < layer.distance_mm;
  });
}

}  // namespace

void MeshScene::staticHits(const RayBatch& rays, MeshHits& hits) const {
  std::fill_n(hits.distance_mm, rays.count, 0.0f);
  if (has(MeshGroup::fixed)) trace(*this, scene(MeshGroup::fixed), rays, rays.far_mm, hits);
}

void MeshScene::veilHits(const RayBatch& rays, MeshHits& hits) const {
  std::fill_n(hits.distance_mm, rays.count, 0.0f);
  trace(*this, scene(MeshGroup::veil), rays, rays.far_mm, hits);
}

void MeshScene::addDynamicHits(const RayBatch& rays, MeshHits& hits) const {
  if (!has(MeshGroup::moving)) return;
  alignas(64) float limit_mm[RayBatch::kMaxRays];
  if (mayMeetDynamic(*this, rays, limit_mm, hits)) trace(*this, scene(MeshGroup::moving), rays, limit_mm, hits);
}

void MeshScene::addSeen(const RayBatch& rays, const MeshHits& hits, const float* seen_mm, MeshPoints& to) const {
  to.makeRoom(rays.count);
  for (int r = 0; r < rays.count; ++r) {
    if (hits.distance_mm[r] == 0.0f || seen_mm[r] < hits.distance_mm[r]) continue;
    const MeshBody& body = all()[hits.body[r]];
    add(to, rays, body, body.parts[hits.part[r]], hits.triangle[r], hits.u[r], hits.v[r], r, hits.distance_mm[r],
        hits.faces_eye[r], 1.0f);
  }
}

void MeshScene::layers(const RayBatch& rays, const float* limit_mm, const MeshHits* veil, MeshPoints& to) const {
  static thread_local std::vector<Layer> met;
  met.clear();
  for (int r = 0; veil != nullptr && r < rays.count; ++r)
    if (veil->distance_mm[r] > 0.0f && veil->distance_mm[r] < limit_mm[r])
      met.push_back({.ray = r,
                     .distance_mm = veil->distance_mm[r],
                     .u = veil->u[r],
                     .v = veil->v[r],
                     .body = veil->body[r],
                     .part = veil->part[r],
                     .triangle = veil->triangle[r],
                     .faces_eye = veil->faces_eye[r]});
  const std::size_t of_veil = met.size();
  Query query = queryFor(*this, &met);
  alignas(32) RTCRayHit8 packet;
  alignas(32) int valid[kPacket];
  const auto collect = [&](RTCScene in, const float* before_mm) {
    for (int first = 0; first < rays.count; first += kPacket) {
      fill(packet, valid, rays, first, before_mm);
      rtcIntersect8(valid, in, &query.context, &packet);
    }
  };
  if (has(MeshGroup::transparent)) collect(scene(MeshGroup::transparent), limit_mm);
  const std::size_t first_overlay = met.size();
  if (has(MeshGroup::overlay)) collect(scene(MeshGroup::overlay), rays.far_mm);
  removeOccluded(*this, rays, limit_mm, met, first_overlay);
  if (met.empty()) return;

  // Ray by ray from back to front; at equal distance the later body is in front. The veil alone is in order.
  if (met.size() > of_veil)
    std::ranges::sort(met, [](const Layer& a, const Layer& b) {
      return std::tuple(a.ray, -a.distance_mm, a.body, a.part, a.triangle) <
             std::tuple(b.ray, -b.distance_mm, b.body, b.part, b.triangle);
    });
  to.makeRoom(static_cast<int>(met.size()));
  for (const Layer& layer : met) {
    const MeshBody& body = all()[layer.body];
    add(to, rays, body, body.parts[layer.part], layer.triangle, layer.u, layer.v, layer.ray, layer.distance_mm,
        layer.faces_eye, opacityOf(body.model));
  }
}

}  // namespace render

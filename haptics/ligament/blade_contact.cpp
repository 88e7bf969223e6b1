#include "haptics/ligament/blade_contact.h"

#include <algorithm>
#include <cmath>

namespace haptics {
namespace {

using calibration::Patient;
using calibration::Piece;
using calibration::Point;
using calibration::Tool;

constexpr double kNear_mm = 0.8;
constexpr double kFieldBand_mm = 1.55;  // of the fields of a site, where they still tell

float narrow(double value) { return static_cast<float>(value); }

struct Around {
  double mm;
  glm::dvec3 out;
};

/// Weights of a quadratic B-spline for a voxel and its neighbours, `f` from -0.5 to 0.5 away, and their slopes.
struct Spline {
  double weight[3], slope[3];
  explicit Spline(double f)
      : weight{0.5 * (0.5 - f) * (0.5 - f), 0.75 - f * f, 0.5 * (0.5 + f) * (0.5 + f)},
        slope{f - 0.5, -2.0 * f, f + 0.5} {}
};

/// Smooth, with a continuous slope: where balls of 200 N/mm stand on the faces of cells, a trilinear one has kinks of
/// some newtons. Beyond the grid as at the nearest place in it.
Around around(const DistanceField& field, const glm::dvec3& p_mm) noexcept {
  const assets::VolumeGrid& grid = field.grid();
  const glm::ivec3 size = grid.size;
  const glm::dvec3 index = grid.indexFromPoint(p_mm), inside = glm::clamp(index, glm::dvec3(0.0), glm::dvec3(size - 1));
  const glm::ivec3 middle(inside + 0.5);
  const glm::dvec3 f = inside - glm::dvec3(middle);
  const Spline x(f.x), y(f.y), z(f.z);
  const auto beside = [](int i, int n, int end) { return std::clamp(i + n - 1, 0, end - 1); };
  const int i[3] = {beside(middle.x, 0, size.x), middle.x, beside(middle.x, 2, size.x)};
  const float* const voxels = field.voxels_mm().data();
  double mm = 0.0;
  glm::dvec3 slope(0.0);
  for (int c = 0; c < 3; ++c)
    for (int b = 0; b < 3; ++b) {
      const float* const row =
          voxels + static_cast<std::size_t>(size.x) *
                       static_cast<std::size_t>(beside(middle.y, b, size.y) + size.y * beside(middle.z, c, size.z));
      double sum = 0.0, rise = 0.0;
      for (int a = 0; a < 3; ++a) {
        const double value = static_cast<double>(row[i[a]]);
        sum += x.weight[a] * value;
        rise += x.slope[a] * value;
      }
      mm += y.weight[b] * z.weight[c] * sum;
      slope.x += y.weight[b] * z.weight[c] * rise;
      slope.y += y.slope[b] * z.weight[c] * sum;
      slope.z += y.weight[b] * z.slope[c] * sum;
    }
  for (int axis = 0; axis < 3; ++axis)
    if (index[axis] != inside[axis]) slope[axis] = 0.0;
  return {mm, slope / grid.spacing_mm};
}

bool isNear(const DistanceField* field, double radius_mm, const glm::dvec3& p_mm) noexcept {
  if (field == nullptr) return false;
  const double near_mm = std::min(radius_mm + kNear_mm + field->grid().spacing_mm, kFieldBand_mm);
  return static_cast<double>(field->near(glm::vec3(field->grid().indexFromPoint(p_mm)))) < near_mm;
}

}  // namespace

glm::dvec3 inOutline(const ElevatorShape& shape, const glm::dvec3& v) noexcept {
  return shape.across == 0 ? glm::dvec3(v.y, v.z, v.x) : glm::dvec3(v.z, v.x, v.y);
}
glm::dvec3 fromOutline(const ElevatorShape& shape, const glm::dvec3& v) noexcept {
  return shape.across == 0 ? glm::dvec3(v.z, v.x, v.y) : glm::dvec3(v.y, v.z, v.x);
}

BladeOutline outlineOf(const ElevatorShape& shape) noexcept {
  BladeOutline blade{};
  for (std::size_t n = 0; n < 4; ++n) {
    const glm::dvec2 from = shape.corner_mm[n], along = shape.corner_mm[(n + 1) % 4] - from;
    const double length2 = glm::dot(along, along);
    // An edge of no length lies nowhere.
    const glm::dvec2 out = length2 > 0.0 ? glm::dvec2(along.y, -along.x) / std::sqrt(length2) : glm::dvec2(0.0);
    for (int axis = 0; axis < 2; ++axis) {
      blade.corner[n][axis] = narrow(from[axis]);
      blade.along[n][axis] = narrow(along[axis]);
      blade.out[n][axis] = narrow(out[axis]);
    }
    blade.offset[n] = length2 > 0.0 ? narrow(glm::dot(from, out)) : 1e9F;
    blade.per_length2[n] = length2 > 0.0 ? narrow(1.0 / length2) : 0.0F;
  }
  blade.half = narrow(shape.half_mm);
  blade.edge_radius = narrow(shape.edge_radius_mm);
  blade.shaft = shape.across == 0 ? 1 : 0;
  blade.shank_radius = narrow(shape.shank_radius_mm);
  blade.shank_from = narrow(shape.shank_from_mm);
  blade.shank_to = narrow(shape.shank_to_mm);
  const glm::dvec3 middle = inOutline(shape, shape.middle_T_mm);
  for (int axis = 0; axis < 3; ++axis) blade.middle[axis] = narrow(middle[axis]);
  blade.reach = narrow(shape.reach_mm);
  return blade;
}

BladePlace placeOf(const ElevatorShape& shape, const ToolPose& X_PT, const PiecePose& X_PQ,
                   const glm::dvec3& centre_Q_mm) noexcept {
  const calibration::Pose<Tool, Piece> X_TQ = X_PT.inverse() * X_PQ;
  const glm::dvec3 shift = inOutline(shape, (X_TQ * Point<Piece>{centre_Q_mm}).mm);
  BladePlace place{};
  for (int column = 0; column < 3; ++column) {
    glm::dvec3 unit(0.0);
    unit[column] = 1.0;
    const glm::dvec3 turned = inOutline(shape, X_TQ.rotation * unit);
    for (int row = 0; row < 3; ++row) place.turn[3 * row + column] = narrow(turned[row]);
    place.shift[column] = narrow(shift[column]);
  }
  return place;
}

void BladeContacts::find(const ElevatorShape& shape, const ElevatorScene& scene, const PieceSamples* samples,
                         double point_N_per_mm, double contact_N_per_mm3, const ToolPose& X_PT,
                         const PiecePose& X_PQ) noexcept {
  shape_ = &shape;
  scene_ = scene;
  point_N_per_mm_ = point_N_per_mm;
  against_obstacles_.count = against_piece_.count = samples_count_ = 0;

  const calibration::Pose<Piece, Patient> X_QP = X_PQ.inverse();
  for (std::size_t n = 0; n < static_cast<std::size_t>(shape.points); ++n) {
    const Point<Patient> p_P = X_PT * Point<Tool>{shape.point_T_mm[n]};
    const auto add = [&](auto& list) { list.index[list.count++] = static_cast<std::uint16_t>(n); };
    if (isNear(scene.obstacles, shape.point_radius_mm[n], p_P.mm)) add(against_obstacles_);
    if (isNear(scene.piece, shape.point_radius_mm[n], (X_QP * p_P).mm)) add(against_piece_);
  }
  if (samples == nullptr) return;

  outline_ = outlineOf(shape);
  centre_Q_mm_ = samples->centre_Q_mm;
  const BladePlace place = placeOf(shape, X_PT, X_PQ, centre_Q_mm_);
  std::array<std::uint16_t, kMostSamples> index{};
  const auto& p = samples->place_mm;
  const int found =
      nearBlade(outline_, place, {p[0].data(), p[1].data(), p[2].data(), static_cast<int>(samples->size())},
                narrow(kNear_mm), index.data(), static_cast<int>(kMostSamples));
  const auto take = [&](std::size_t to, std::size_t from) {
    x_[to] = p[0][from];
    y_[to] = p[1][from];
    z_[to] = p[2][from];
    N_per_mm_[to] = narrow(contact_N_per_mm3) * samples->area_mm2[from];
  };
  const auto padded = [&](std::size_t count) {
    for (; count % kSampleLanes != 0; ++count) {
      x_[count] = y_[count] = z_[count] = 0.0F;
      N_per_mm_[count] = 0.0F;
    }
    return count;
  };
  for (std::size_t n = 0; n < static_cast<std::size_t>(found); ++n) take(n, index[n]);
  samples_count_ = padded(static_cast<std::size_t>(found));

  // Of these the ones that are near the surface itself.
  bladeGaps(outline_, place, {x_.data(), y_.data(), z_.data(), static_cast<int>(samples_count_)},
            {gap_.data(), out_u_.data(), out_v_.data(), out_s_.data()});
  std::size_t kept = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(found); ++n)
    if (gap_[n] < narrow(kNear_mm) && N_per_mm_[n] > 0.0F) take(kept++, index[n]);
  samples_count_ = padded(kept);
}

double BladeContacts::press(const ToolPose& X_PT, const PiecePose& X_PQ, PairBalance& balance) noexcept {
  pressing_count_ = 0;
  const auto ball = [&](const DistanceField& field, BladeContact::On on, std::size_t point, const glm::dvec3& p_P_mm,
                        const glm::dvec3& p_mm) {
    const double radius_mm = shape_->point_radius_mm[point];
    const Around near = around(field, p_mm);
    const double steep = glm::length(near.out);
    if (near.mm >= radius_mm || steep < 1e-3) return;
    add({on, p_P_mm, near.out / steep, (radius_mm - near.mm) / steep, point_N_per_mm_ * steep * steep});
  };
  for (std::size_t n = 0; n < against_obstacles_.count; ++n) {
    const std::size_t point = against_obstacles_.index[n];
    const glm::dvec3 p_P_mm = (X_PT * Point<Tool>{shape_->point_T_mm[point]}).mm;
    ball(*scene_.obstacles, BladeContact::On::obstacle, point, p_P_mm, p_P_mm);
  }
  const std::size_t of_obstacles = pressing_count_;
  const calibration::Pose<Piece, Patient> X_QP = X_PQ.inverse();
  for (std::size_t n = 0; n < against_piece_.count; ++n) {
    const std::size_t point = against_piece_.index[n];
    const Point<Patient> p_P = X_PT * Point<Tool>{shape_->point_T_mm[point]};
    ball(*scene_.piece, BladeContact::On::piece, point, p_P.mm, (X_QP * p_P).mm);
  }
  for (std::size_t n = of_obstacles; n < pressing_count_; ++n) pressing_[n].out_P = X_PQ.rotation * pressing_[n].out_P;

  if (samples_count_ > 0)
    bladeGaps(outline_, placeOf(*shape_, X_PT, X_PQ, centre_Q_mm_),
              {x_.data(), y_.data(), z_.data(), static_cast<int>(samples_count_)},
              {gap_.data(), out_u_.data(), out_v_.data(), out_s_.data()});
  for (std::size_t n = 0; n < samples_count_; ++n) {
    if (gap_[n] >= 0.0F || N_per_mm_[n] == 0.0F) continue;
    const glm::dvec3 out_T = fromOutline(*shape_, glm::dvec3(out_u_[n], out_v_[n], out_s_[n]));
    add({BladeContact::On::piece, (X_PQ * Point<Piece>{centre_Q_mm_ + glm::dvec3(x_[n], y_[n], z_[n])}).mm,
         -(X_PT.rotation * out_T), static_cast<double>(-gap_[n]), static_cast<double>(N_per_mm_[n])});
  }

  const glm::dvec3 middle_P_mm = (X_PT * Point<Tool>{shape_->middle_T_mm}).mm;
  const glm::dvec3 centre_P_mm = (X_PQ * Point<Piece>{centre_Q_mm_}).mm;
  double stored_Nmm = 0.0;
  for (const BladeContact& contact : pressing()) {
    const bool on_piece = contact.on == BladeContact::On::piece;
    const Twelve way = wayAlong(contact.out_P, contact.at_P_mm - middle_P_mm, contact.at_P_mm - centre_P_mm, on_piece);
    stored_Nmm += 0.5 * contact.push_N() * contact.depth_mm;
    balance.addAlong(way, -contact.push_N(), contact.N_per_mm, on_piece ? 2 : 1);
  }
  balance.energy_Nmm += stored_Nmm;
  return stored_Nmm;
}

bool BladeContacts::isOnTeeth(const BladeContact& contact) const noexcept {
  if (scene_.teeth == nullptr) return false;
  const double obstacle_mm = around(*scene_.obstacles, contact.at_P_mm).mm;
  return around(*scene_.teeth, contact.at_P_mm).mm < obstacle_mm + 0.5 * scene_.teeth->grid().spacing_mm;
}

}  // namespace haptics

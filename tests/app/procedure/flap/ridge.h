// A round ridge of bone under a round layer of gum, with a cut planned on top of it, and a hand that works on it.
#pragma once

#include <cmath>
#include <memory>

#include "app/procedure/flap/flap.h"

namespace app {

struct Ridge {
  static constexpr double kBone_mm = 8.0, kGum_mm = 10.0, kHalf_mm = 24.0;

  assets::Patient patient;
  assets::MeshModel gum;
  assets::PlannedCut cut;
  assets::SoftTissueField soft;

  Ridge() {
    assets::CtVolume& ct = patient.ct;
    ct.grid = {{60, 100, 60}, 0.5, {-15.0, -25.0, -15.0}};
    ct.label.assign(ct.grid.voxelCount(), 0), ct.solid.assign(ct.grid.voxelCount(), 0);
    assets::forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
      const glm::dvec3 p = ct.grid.centre_P_mm(ijk);
      const double inside = 0.5 + (kBone_mm - std::hypot(p.x, p.z)) / 0.5;
      ct.solid[v] = static_cast<std::uint8_t>(255.0 * std::min(1.0, std::max(0.0, inside)));
    });
    assets::MeshPart part;
    part.name = "Gum";
    constexpr int kAround = 180, kAlong = 48;
    for (int y = 0; y <= kAlong; ++y)
      for (int a = 0; a < kAround; ++a) {
        const double turn = 2.0 * M_PI * a / kAround;
        const glm::vec3 out(std::sin(turn), 0.0f, std::cos(turn));
        part.position_mm.push_back(static_cast<float>(kGum_mm) * out + glm::vec3(0.0f, -kHalf_mm + y, 0.0f));
        part.normal.push_back(out);
      }
    const auto at = [](int y, int a) { return static_cast<std::uint32_t>(y * kAround + a % kAround); };
    for (int y = 0; y < kAlong; ++y)
      for (int a = 0; a < kAround; ++a)
        part.triangles.insert(part.triangles.end(),
                              {at(y, a), at(y, a + 1), at(y + 1, a + 1), at(y, a), at(y + 1, a + 1), at(y + 1, a)});
    gum.parts.push_back(part);
    cut.strokes_P_mm = {{{0.0, 6.0, kBone_mm}, {0.0, -6.0, kBone_mm}}};
    cut.surface_P_mm = {0.0, 0.0, kBone_mm};
    cut.outward_P = {0.0, 0.0, 1.0}, cut.lateral_P = {1.0, 0.0, 0.0};
  }
};

/// Ticks of a millisecond.
struct WorkedRidge {
  Ridge ridge;
  Flap flap{ridge.patient, ridge.gum, ridge.cut, ridge.soft, {0.0, 0.0, -1.0}};
  haptics::Command command;
  double t_s = 0.0;

  void take(haptics::HandInstrument kind) { command.tool = haptics::handInstrumentTool(kind); }
  void tick(const glm::dvec3& p, bool meets = false, bool drills = false) {
    haptics::Tick tick;
    tick.t_s = t_s, tick.dt_s = 0.001;
    t_s += tick.dt_s;
    tick.proxy_P.mm = p;
    tick.depth_mm = meets ? 0.1 : 0.0;
    tick.drilling = drills;
    flap.follow(tick, command);
  }
  void rest(double seconds) {
    for (int n = 0; n < 1000.0 * seconds; ++n) tick({0.0, 0.0, 100.0});
  }
  glm::dvec3 at(const ChartPlace& place, double over_bone_mm) const {
    return flap.chart().point_P_mm(place, flap.chart().bone_mm(place) + over_bone_mm);
  }
  /// Along the planned incision at 10 mm/s.
  void incise(double over_bone_mm = 0.3, bool meets = true, double tremor_mm = 0.0) {
    take(haptics::HandInstrument::scalpel_15);
    const std::vector<ChartPlace>& line = flap.plan().incision();
    for (std::size_t n = 1; n < line.size(); ++n) {
      const double mm = glm::distance(flap.chart().surface_P_mm(line[n - 1]), flap.chart().surface_P_mm(line[n]));
      const int steps = std::max(1, static_cast<int>(mm / 0.01));
      for (int step = 0; step < steps; ++step) {
        const double part = static_cast<double>(step) / steps;
        const ChartPlace place{glm::mix(line[n - 1].m_mm, line[n].m_mm, part),
                               glm::mix(line[n - 1].angle_rad, line[n].angle_rad, part)};
        const glm::dvec3 shake(std::sin(2.0 * M_PI * 9.0 * t_s), std::sin(2.0 * M_PI * 11.0 * t_s), 0.0);
        tick(at(place, over_bone_mm) + tremor_mm * shake, meets);
      }
    }
    rest(0.2);
  }
  void raise(double share = 1.0) {
    take(haptics::HandInstrument::periosteal);
    const std::vector<ChartPlace>& line = flap.plan().incision();
    const double first = line.front().m_mm, last = line.back().m_mm;
    for (double m = first + 0.5; m < first + share * (last - first); m += 1.5) {
      double top = 10.0;
      for (const ChartPlace& place : line)
        if (std::abs(place.m_mm - m) < 0.5) top = std::min(top, place.angle_rad);
      for (double angle = top; angle < flap.plan().base_rad() + 0.1; angle += 0.0012) tick(at({m, angle}, 0.6), true);
      rest(0.05);
    }
    rest(0.2);
  }
};

}  // namespace app

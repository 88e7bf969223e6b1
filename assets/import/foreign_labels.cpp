#include "assets/import/foreign_labels.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "assets/import/divided_teeth.h"
#include "assets/import/label_names.h"
#include "assets/import/tissue_from_grey.h"
#include "assets/load_error.h"
#include "assets/scan/image_file.h"
#include "assets/tooth.h"

namespace assets {
namespace {

constexpr const char* kWhere = "labels";

std::string setNames() {
  std::string list;
  for (const std::string_view name : kLabelSets) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

std::array<bool, 256> valuesIn(const std::vector<std::uint8_t>& values) {
  std::array<bool, 256> is_present{};
  for (const std::uint8_t value : values) is_present[value] = true;
  return is_present;
}

/// Share of the smaller box that lies in the other one.
double sharedPart(const VolumeGrid& a, const VolumeGrid& b) {
  const auto ends = [](const VolumeGrid& grid) {
    const glm::dvec3 half(0.5 * grid.spacing_mm);
    return std::pair(grid.origin_P_mm - half, grid.centre_P_mm(grid.size - 1) + half);
  };
  const auto volume = [](const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 edge = glm::max(high - low, glm::dvec3(0.0));
    return edge.x * edge.y * edge.z;
  };
  const auto [a_low, a_high] = ends(a);
  const auto [b_low, b_high] = ends(b);
  return volume(glm::max(a_low, b_low), glm::min(a_high, b_high)) /
         std::min(volume(a_low, a_high), volume(b_low, b_high));
}

/// Nearest value for every voxel of the scan; 0 outside.
std::vector<std::uint8_t> onGrid(const ByteImage& image, const VolumeGrid& grid) {
  std::vector<std::uint8_t> values(grid.voxelCount());
  tbb::parallel_for(tbb::blocked_range<int>(0, grid.size.z), [&](const auto& range) {
    forVoxels({0, 0, range.begin()}, {grid.size.x, grid.size.y, range.end()}, [&](glm::ivec3 ijk) {
      const glm::ivec3 at(glm::round(image.grid.indexFromPoint(grid.centre_P_mm(ijk))));
      if (image.grid.contains(at)) values[grid.index(ijk)] = image.values[image.grid.index(at)];
    });
  });
  return values;
}

constexpr std::array<glm::ivec3, 6> kFaceSteps = {
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// Pulps without a number take that of the tooth that they lie in, from neighbour to neighbour.
void numberPulps(CtVolume& ct) {
  std::vector<std::size_t> front;
  const auto is_open = [&](std::size_t v) { return Tissue{ct.label[v]} == Tissue::pulp && ct.tooth[v] == 0; };
  const auto spread = [&](std::size_t v, auto&& take) {
    const glm::ivec3 at = elementAt(ct.grid.size, v);
    for (const glm::ivec3& step : kFaceSteps)
      if (ct.grid.contains(at + step)) take(ct.grid.index(at + step));
  };
  for (std::size_t v = 0; v < ct.label.size(); ++v)
    if (is_open(v))
      spread(v, [&](std::size_t next) {
        if (ct.tooth[v] == 0 && ct.tooth[next] != 0 && Tissue{ct.label[next]} != Tissue::pulp) {
          ct.tooth[v] = ct.tooth[next];
          front.push_back(v);
        }
      });
  for (std::size_t n = 0; n < front.size(); ++n)
    spread(front[n], [&](std::size_t next) {
      if (!is_open(next)) return;
      ct.tooth[next] = ct.tooth[front[n]];
      front.push_back(next);
    });
}

/// Left teeth lie at larger x than right ones: P is LPS.
void refuseSwappedSides(const CtVolume& ct) {
  std::array<double, 2> sum{}, count{};
  forVoxels(ct.grid, [&](glm::ivec3 ijk, std::size_t v) {
    if (ct.tooth[v] == 0) return;
    const std::size_t side = isRight(ct.tooth[v]) ? 0 : 1;
    sum[side] += ijk.x, count[side] += 1.0;
  });
  if (count[0] > 0.0 && count[1] > 0.0 && sum[0] / count[0] > sum[1] / count[1])
    throw LoadError(std::string(kWhere) +
                    ": the teeth that they call left lie on the right; they are mirrored or number the teeth another "
                    "way, see --label-set");
}

Tissue boneTissue(int hounsfield) { return hounsfield > 700 ? Tissue::cortical : Tissue::trabecular; }

}  // namespace

LabelTable foreignLabelTable(const std::string& path, const std::optional<LabelSet>& stated) {
  if (stated) {
    const auto table = labelTable(*stated, valuesIn(readLabels(path).values));
    if (table) return *table;
    throw LoadError(std::string(kWhere) +
                    ": both numberings of ToothFairy fit their values; give --label-set toothfairy-fdi or "
                    "toothfairy-contiguous");
  }
  const std::map<int, std::string> names = labelNames(path);
  if (names.empty())
    throw LoadError(std::string(kWhere) +
                    ": the file does not name its values; say whose they are with --label-set: " + setNames());
  return labelTable(names);
}

void fillHoles(glm::ivec3 size, std::vector<std::uint8_t>& is_in) {
  const std::vector<std::uint8_t> before = is_in;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    // Slices along one axis touch no voxel of each other.
    tbb::parallel_for(tbb::blocked_range<int>(0, size[axis]), [&](const auto& range) {
      std::vector<std::uint8_t> is_outside(static_cast<std::size_t>(size[u]) * static_cast<std::size_t>(size[v]));
      std::vector<glm::ivec2> front;
      for (int slice = range.begin(); slice < range.end(); ++slice) {
        std::ranges::fill(is_outside, std::uint8_t{0});
        front.clear();
        const auto voxel = [&](glm::ivec2 at) {
          glm::ivec3 ijk(slice);
          ijk[u] = at.x, ijk[v] = at.y;
          return indexIn(size, ijk);
        };
        const auto visit = [&](glm::ivec2 at) {
          if (at.x < 0 || at.y < 0 || at.x >= size[u] || at.y >= size[v]) return;
          std::uint8_t& seen = is_outside[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size[u]) +
                                          static_cast<std::size_t>(at.x)];
          if (seen != 0 || before[voxel(at)] != 0) return;
          seen = 1;
          front.push_back(at);
        };
        for (int a = 0; a < size[u]; ++a) visit({a, 0}), visit({a, size[v] - 1});
        for (int b = 0; b < size[v]; ++b) visit({0, b}), visit({size[u] - 1, b});
        for (std::size_t n = 0; n < front.size(); ++n)
          for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)})
            visit(front[n] + step);
        for (int b = 0; b < size[v]; ++b)
          for (int a = 0; a < size[u]; ++a)
            if (is_outside[static_cast<std::size_t>(b) * static_cast<std::size_t>(size[u]) +
                           static_cast<std::size_t>(a)] == 0)
              is_in[voxel({a, b})] = 1;
      }
    });
  }
}

std::vector<std::string> takeForeignLabels(const std::string& path, const LabelTable& table, CtVolume& ct) {
  const ByteImage image = readLabels(path);
  constexpr double kLeastShared = 0.5;
  if (!(sharedPart(image.grid, ct.grid) >= kLeastShared))
    throw LoadError(std::string(kWhere) +
                    ": less than half of them lies in the scan; they belong to another scan or another frame");
  const std::vector<std::uint8_t> values = onGrid(image, ct.grid);

  std::vector<std::uint8_t> is_mandible(values.size());
  std::ranges::transform(values, is_mandible.begin(), [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(table[value].kind == LabelKind::mandible ? 1 : 0);
  });
  fillHoles(ct.grid.size, is_mandible);

  ct.label.assign(values.size(), 0);
  ct.tooth.assign(values.size(), 0);
  std::size_t useful = 0;
  std::array<std::size_t, 7> count{};
  for (std::size_t v = 0; v < values.size(); ++v) {
    const LabelMeaning& meaning = table[values[v]];
    ++count[static_cast<std::size_t>(meaning.kind)];
    Tissue tissue = is_mandible[v] != 0 ? boneTissue(ct.hounsfield[v]) : Tissue::unlabelled;
    if (meaning.kind == LabelKind::canal) tissue = Tissue::mandibular_canal;
    if (meaning.kind == LabelKind::teeth) tissue = Tissue::other_teeth;
    if (meaning.kind == LabelKind::pulp) tissue = Tissue::pulp;
    if (meaning.kind == LabelKind::tissue) tissue = meaning.tissue;
    if (meaning.kind == LabelKind::tooth) tissue = Tissue::unlabelled;  // by its grey value, below
    ct.label[v] = static_cast<std::uint8_t>(tissue);
    ct.tooth[v] = static_cast<std::uint8_t>(meaning.fdi);
    useful += meaning.kind == LabelKind::nothing ? 0 : 1;
  }
  const auto voxels = [&](LabelKind kind) { return count[static_cast<std::size_t>(kind)]; };
  if (useful == 0)
    throw LoadError(std::string(kWhere) + ": nothing of a lower jaw is labelled in them; see --label-set");
  const bool has_numbers = voxels(LabelKind::tooth) > 0;
  if (has_numbers) {
    refuseSwappedSides(ct);
    numberPulps(ct);
    labelNumberedTeeth(ct);
  }
  std::vector<std::string> remarks;
  if (voxels(LabelKind::teeth) > 0 && !has_numbers) {
    const std::size_t teeth = divideLabelledTeeth(ct);
    for (std::size_t v = 0; v < ct.label.size(); ++v)
      if (ct.tooth[v] != 0) ct.label[v] = 0;
    labelNumberedTeeth(ct);
    remarks.push_back(teeth > 0 ? "labels: the teeth are one label, divided into " + std::to_string(teeth) +
                                      " at their necks and numbered along the arch: look at the numbers"
                                : "labels: the teeth are one label, not told apart, so that none can be the site");
  }
  if (std::ranges::none_of(ct.tooth, [](std::uint8_t fdi) { return fdi != 0; })) ct.tooth.clear();
  if (voxels(LabelKind::canal) == 0 && voxels(LabelKind::tissue) == 0)
    remarks.push_back("labels: no mandibular canal is among them");
  return remarks;
}

}  // namespace assets

#include "assets/scan/nrrd_axes.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "assets/scan/header_text.h"

namespace assets {

namespace {

struct Axis {
  std::int64_t size = 0;
  bool is_spatial = true;
  double spacing = std::numeric_limits<double>::quiet_NaN();  ///< in `unit`
  std::optional<glm::dvec3> step;                             ///< along the axes of the file's space
  double mm_per_unit = 1.0;
  double first = 0.0;  ///< centre of the first voxel, if there are no directions
};

class NrrdAxes {
 public:
  explicit NrrdAxes(const NrrdFields& fields) : fields_(fields) {
    readAxes();
    keepThreeAxes();
  }

  ScanGeometry geometry() const {
    ScanGeometry result;
    const glm::dvec3 signs = signsOfSpace();
    const glm::dvec3 mm = signs * millimetresPerSpaceUnit();
    for (int a = 0; a < 3; ++a) {
      const Axis& axis = axes_[static_cast<std::size_t>(a)];
      result.size[a] = static_cast<int>(axis.size);
      if (axis.step) {
        if (!std::isnan(axis.spacing)) fields_.refuseField("spacings");
        if (axis.mm_per_unit != 1.0)
          refuseScan(fields_.path(),
                     "its units " + printableExcerpt(fields_["units"]) +
                         " belong to axes with directions, which are in the unit of the space; export it in mm");
        result.step_P_mm[a] = mm * *axis.step;
        continue;
      }
      if (!fields_.has("spacings")) refuseScan(fields_.path(), "it states no voxel size; export it with spacing");
      if (!(axis.spacing > 0.0) || !std::isfinite(axis.spacing))
        fields_.refuse("its spacings " + printableExcerpt(fields_["spacings"]) + " are not all positive");
      if (signs != glm::dvec3(1.0))
        refuseScan(fields_.path(), "it states no axis directions in its space; export it with space directions");
      result.step_P_mm[a] = glm::dvec3(0.0);
      result.step_P_mm[a][a] = axis.mm_per_unit * axis.spacing;
      result.origin_P_mm[a] = axis.mm_per_unit * axis.first;
    }
    if (fields_.has("spacedirections") && !fields_.has("space") && !fields_.has("spacedimension"))
      refuseScan(fields_.path(), "it has directions but no space; export it as left-posterior-superior");
    if (fields_.has("spaceorigin")) result.origin_P_mm = mm * vector("spaceorigin", fields_["spaceorigin"]);
    return result;
  }

 private:
  /// One item per axis, or none.
  std::vector<std::string> perAxis(const std::string& name) const { return fields_.items(name, axes_.size()); }

  void readAxes() {
    const auto dimension = parseInteger(fields_.required("dimension"));
    if (!dimension || *dimension < 1 || *dimension > 16) fields_.refuseField("dimension");
    axes_.resize(static_cast<std::size_t>(*dimension));
    fields_.required("sizes");
    const std::vector<std::string> sizes = perAxis("sizes");
    const std::vector<std::string> spacings = perAxis("spacings"), kinds = perAxis("kinds"), units = perAxis("units");
    const std::vector<std::string> directions = perAxis("spacedirections");
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      Axis& axis = axes_[a];
      axis.size = parseInteger(sizes[a]).value_or(0);
      if (axis.size < 1 || axis.size > std::numeric_limits<int>::max()) fields_.refuseField("sizes");
      if (!spacings.empty()) {
        const auto spacing = parseReal(spacings[a]);
        if (!spacing) fields_.refuseField("spacings");
        axis.spacing = *spacing;
      }
      if (!units.empty()) axis.mm_per_unit = unit(units[a]);
      if (!kinds.empty()) axis.is_spatial = isSpatial(lowerCase(kinds[a]));
      if (!directions.empty() && lowerCase(directions[a]) != "none")
        axis.step = vector("spacedirections", directions[a]);
      if (directions.empty() ? !spacings.empty() && std::isnan(axis.spacing) : !axis.step) axis.is_spatial = false;
    }
    readAxisMins();
  }

  /// Without directions: start of an axis, from its lowest edge, or its first sample if centred on nodes.
  void readAxisMins() {
    const std::vector<std::string> mins = perAxis("axismins");
    const std::vector<std::string> centers = perAxis(fields_.has("centers") ? "centers" : "centerings");
    bool is_placed = !mins.empty();
    for (std::size_t a = 0; a < mins.size(); ++a) {
      const auto lowest = parseReal(mins[a]);
      if (!lowest) fields_.refuseField("axismins");
      const bool is_node = !centers.empty() && lowerCase(centers[a]) == "node";
      axes_[a].first = *lowest + (is_node ? 0.0 : 0.5 * axes_[a].spacing);
      is_placed = is_placed && (!axes_[a].is_spatial || std::isfinite(*lowest));
    }
    if (!is_placed)
      for (Axis& axis : axes_) axis.first = 0.0;
  }

  static bool isSpatial(const std::string& kind) {
    return kind == "domain" || kind == "space" || kind == "time" || kind == "none" || kind == "???" ||
           kind == "unknown";
  }

  double unit(std::string word) const {
    std::erase(word, '"');
    const auto mm = millimetresPer(trimmed(word));
    if (!mm)
      refuseScan(fields_.path(), "its unit " + printableExcerpt(word) + " is not a known length; export it in mm");
    return *mm;
  }

  glm::dvec3 vector(const std::string& field, std::string text) const {
    if (!text.starts_with('(') || !text.ends_with(')')) fields_.refuseField(field);
    text = text.substr(1, text.size() - 2);
    if (std::count(text.begin(), text.end(), ',') != 2) fields_.refuseField(field);
    std::replace(text.begin(), text.end(), ',', ' ');
    const auto numbers = parseReals(text, 3);
    if (!numbers) fields_.refuseField(field);
    return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
  }

  /// Drops non-spatial axes, then axes of size 1 from the end, until three are left.
  void keepThreeAxes() {
    const std::string axes = "it has " + std::to_string(axes_.size()) + " axes; give a volume with three";
    for (const Axis& axis : axes_)
      if (!axis.is_spatial && axis.size > 1 && std::isnan(axis.spacing) && fields_.has("spacings"))
        fields_.refuse("its spacings " + printableExcerpt(fields_["spacings"]) + " are not finite numbers");
      else if (!axis.is_spatial && axis.size > 1)
        refuseSeveralValues(fields_.path());
    std::erase_if(axes_, [](const Axis& axis) { return !axis.is_spatial; });
    while (axes_.size() > 3) {
      const auto single = std::find_if(axes_.rbegin(), axes_.rend(), [](const Axis& axis) { return axis.size == 1; });
      if (single == axes_.rend()) refuseScan(fields_.path(), axes);
      axes_.erase(std::next(single).base());
    }
    if (axes_.size() < 3) refuseScan(fields_.path(), axes);
  }

  /// Signs of x, y and z from the file's space to LPS.
  glm::dvec3 signsOfSpace() const {
    const std::string space = lowerCase(fields_["space"]);
    if (fields_.has("spacedimension") && (!space.empty() || fields_["spacedimension"] != "3"))
      fields_.refuseField("spacedimension");
    if (space.empty() || space == "left-posterior-superior" || space == "lps") return glm::dvec3(1.0);
    if (space == "right-anterior-superior" || space == "ras") return {-1.0, -1.0, 1.0};
    refuseScan(fields_.path(),
               "its space " + printableExcerpt(space) + " is not supported; export it as left-posterior-superior");
  }

  glm::dvec3 millimetresPerSpaceUnit() const {
    glm::dvec3 mm(1.0);
    const std::vector<std::string> units = fields_.items("spaceunits", 3);
    for (std::size_t p = 0; p < units.size(); ++p) mm[static_cast<int>(p)] = unit(units[p]);
    return mm;
  }

  const NrrdFields& fields_;
  std::vector<Axis> axes_;
};

}  // namespace

ScanGeometry nrrdGeometry(const NrrdFields& fields) { return NrrdAxes(fields).geometry(); }

}  // namespace assets

#include "app/options/iso_bur.h"

#include <array>

#include <fmt/core.h>

#include "app/text/list.h"
#include "app/text/parse_number.h"
#include "app/text/usage_error.h"

namespace app {
namespace {

using assets::BurProfile;
using haptics::BurShape;
using haptics::ShapeKind;

struct IsoShape {
  int number;
  ShapeKind kind;
  BurProfile profile;
  double length_mm;  ///< 0: `per_diameter` times the diameter
  double per_diameter = 0.0;
};

// Unverified: from makers' lists, not from the standard.
constexpr auto kIsoShapes = std::to_array<IsoShape>({
    {1, ShapeKind::sphere, BurProfile::wheel, 0.0, 1.0},
    {10, ShapeKind::revolved, BurProfile::inverted_cone, 0.0, 1.0},
    {42, ShapeKind::revolved, BurProfile::wheel, 0.0, 0.35},
    {68, ShapeKind::revolved, BurProfile::wheel, 0.0, 0.5},
    {107, ShapeKind::cylinder, BurProfile::wheel, 3.0},
    {108, ShapeKind::cylinder, BurProfile::wheel, 4.0},
    {110, ShapeKind::cylinder, BurProfile::wheel, 6.0},
    {111, ShapeKind::cylinder, BurProfile::wheel, 8.0},
    {112, ShapeKind::cylinder, BurProfile::wheel, 10.0},
    {140, ShapeKind::revolved, BurProfile::round_cylinder, 6.0},
    {141, ShapeKind::revolved, BurProfile::round_cylinder, 8.0},
    {142, ShapeKind::revolved, BurProfile::round_cylinder, 10.0},
    {171, ShapeKind::revolved, BurProfile::taper, 7.0},
    {172, ShapeKind::revolved, BurProfile::taper, 8.0},
    {173, ShapeKind::revolved, BurProfile::taper, 10.0},
    {197, ShapeKind::revolved, BurProfile::round_taper, 7.0},
    {198, ShapeKind::revolved, BurProfile::round_taper, 8.0},
    {199, ShapeKind::revolved, BurProfile::round_taper, 10.0},
    {237, ShapeKind::revolved, BurProfile::pear, 0.0, 2.0},
    {243, ShapeKind::revolved, BurProfile::flame, 3.0},
    {247, ShapeKind::revolved, BurProfile::flame, 5.0},
    {248, ShapeKind::revolved, BurProfile::flame, 6.0},
    {249, ShapeKind::revolved, BurProfile::flame, 8.0},
    {250, ShapeKind::revolved, BurProfile::flame, 10.0},
    {277, ShapeKind::revolved, BurProfile::egg, 0.0, 1.7},
    {288, ShapeKind::revolved, BurProfile::torpedo, 6.0},
    {289, ShapeKind::revolved, BurProfile::torpedo, 8.0},
    {290, ShapeKind::revolved, BurProfile::torpedo, 10.0},
});

constexpr int kLeastTenths = 2, kMostTenths = 120;

}  // namespace

std::string isoShapes() {
  return joined(kIsoShapes, [](const IsoShape& shape) { return fmt::format("{:03}", shape.number); });
}

haptics::BurShape isoBurFrom(std::string_view text, const std::string& option) {
  const std::string_view numbers = text.substr(0, text.find(','));
  const std::size_t slash = numbers.find('/');
  const auto number = parseNumber<int>(numbers.substr(0, slash));
  const auto tenths = slash == std::string_view::npos ? std::nullopt : parseNumber<int>(numbers.substr(slash + 1));
  if (!number || !tenths)
    throw UsageError(option + ": that is no ISO number, give iso:SHAPE/DIAMETER in tenths of a mm, as iso:289/016");
  const IsoShape* found = nullptr;
  for (const IsoShape& shape : kIsoShapes)
    if (shape.number == *number) found = &shape;
  if (found == nullptr) throw UsageError(option + ": no such ISO shape is made, give one of " + isoShapes());
  if (*tenths < kLeastTenths || *tenths > kMostTenths)
    throw UsageError(fmt::format("{}: the diameter is out of range, give {:03} to {:03} tenths of a mm", option,
                                 kLeastTenths, kMostTenths));
  BurShape head{found->kind, 0.05 * *tenths, 0.0, found->profile};
  if (found->kind != ShapeKind::sphere)
    head.length_mm = found->length_mm > 0.0 ? found->length_mm : 0.1 * *tenths * found->per_diameter;
  if (numbers.size() < text.size()) {
    const auto length_mm = parseNumber<double>(text.substr(numbers.size() + 1));
    if (!length_mm || found->kind == ShapeKind::sphere || *length_mm < haptics::kMinHeadLength_mm || *length_mm > 40.0)
      throw UsageError(option + ": the length is out of range, give 0.1 to 40 mm, or none behind a round bur");
    head.length_mm = *length_mm;
  }
  return head;
}

}  // namespace app

#include "haptics/tool/instrument_outline.h"

#include <algorithm>
#include <cmath>

#include "assets/handpiece_outline.h"

namespace haptics {
namespace {

constexpr double kStep = 0.8;  // between balls, of their radius
constexpr std::size_t kMaxHeadBalls = 16, kMaxShaftBalls = 32;

void add(InstrumentOutline& outline, double z_mm, double radius_mm) {
  if (outline.count < InstrumentOutline::kMaxBalls && radius_mm > 0.0)
    outline.balls[outline.count++] = {z_mm, radius_mm};
}

/// Balls of the same radius from `low_mm` to `high_mm`, both ends included.
void addRow(InstrumentOutline& outline, double low_mm, double high_mm, double radius_mm, std::size_t most) {
  const double length_mm = std::max(0.0, high_mm - low_mm);
  const auto steps = std::min(static_cast<std::size_t>(std::ceil(length_mm / (kStep * radius_mm))), most - 1);
  for (std::size_t n = 0; n <= steps; ++n)
    add(outline, low_mm + (steps > 0 ? length_mm * static_cast<double>(n) / static_cast<double>(steps) : 0.0),
        radius_mm);
}

/// The largest balls inside, at even heights.
void addRevolved(InstrumentOutline& outline, const BurShape& head) {
  const assets::BurOutline form = revolvedOutline(head);
  for (std::size_t n = 0; n < kMaxHeadBalls; ++n) {
    const double z_mm = head.length_mm * ((static_cast<double>(n) + 0.5) / kMaxHeadBalls - 0.5);
    add(outline, z_mm, -assets::outlineDistance_mm(form, 0.0, z_mm));
  }
}

void addHead(InstrumentOutline& outline, const BurShape& head) {
  const double half_mm = halfHeight_mm(head), r = head.radius_mm;
  if (head.kind == ShapeKind::revolved) return addRevolved(outline, head);
  if (head.kind != ShapeKind::cone)
    return addRow(outline, -std::max(0.0, half_mm - r), std::max(0.0, half_mm - r), std::min(r, half_mm),
                  kMaxHeadBalls);
  // Balls that touch the cone's side, from the tip up; the largest also touches its base.
  const double slant_mm = std::hypot(r, head.length_mm), sine = r / slant_mm;
  const double largest_mm = r * head.length_mm / (r + slant_mm);
  const double smallest_mm = 0.15 * largest_mm;
  const double growth = std::max(1.0 + kStep * sine, std::pow(largest_mm / smallest_mm, 1.0 / (kMaxHeadBalls - 1.0)));
  for (double radius_mm = smallest_mm; outline.count < kMaxHeadBalls;) {
    const double ball_mm = std::min(radius_mm, largest_mm);
    add(outline, -half_mm + ball_mm / sine, ball_mm);
    if (radius_mm >= largest_mm) break;
    radius_mm *= growth * (1.0 + 1e-12);
  }
}

}  // namespace

InstrumentOutline outlineOf(const Tool& tool) noexcept {
  InstrumentOutline outline;
  addHead(outline, tool.head);
  outline.head_count = outline.count;

  // The shaft as far as it stands out of the handpiece.
  const double nose_mm = assets::kHandpieceOutline.front().z_mm, end_mm = assets::kHandpieceOutline.back().z_mm;
  const double r = tool.shaft.radius_mm, top_mm = halfHeight_mm(tool.head);
  const double bare_mm = tool.handpiece ? std::min(tool.shaft.length_mm, nose_mm) : tool.shaft.length_mm;
  if (r > 0.0 && bare_mm > top_mm) addRow(outline, top_mm, bare_mm, r, kMaxShaftBalls);

  if (!tool.handpiece) return outline;

  // The handpiece; a ball ends where the body ends.
  for (double z_mm = nose_mm; outline.count < InstrumentOutline::kMaxBalls;) {
    const double radius_mm = assets::handpieceRadius_mm(std::min(z_mm, end_mm));
    if (z_mm + radius_mm > end_mm) break;
    add(outline, std::max(z_mm, nose_mm + radius_mm), assets::handpieceRadius_mm(z_mm));
    z_mm += kStep * radius_mm;
  }
  return outline;
}

}  // namespace haptics

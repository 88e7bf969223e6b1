#include "haptics/file/file_fragments.h"

#include <algorithm>
#include <cmath>

namespace haptics {

using glm::dvec3;

FileFragments::FileFragments(std::span<const assets::MetalFragment> before) noexcept {
  for (const assets::MetalFragment& one : before.first(std::min(before.size(), kMost))) {
    Lying& lying = of_[count_++];
    const std::size_t nodes = std::min({one.node_P_mm.size(), one.radius_mm.size(), lying.node_P_mm.size()});
    lying.links = nodes > 0 ? nodes - 1 : 0;
    for (std::size_t n = 0; n < nodes; ++n) {
      lying.node_P_mm[n] = one.node_P_mm[n];
      lying.radius_mm[n] = one.radius_mm[n];
    }
    lying.was_before = lying.is_met = true;
  }
  count();
}

void FileFragments::leave(const FileFragment& fragment, const FileChain& broken,
                          const StrokeHistory& strokes) noexcept {
  // What was undone cannot be redone after another one.
  forgetUndone();
  if (count_ == kMost) return;
  Lying& lying = of_[count_++];
  lying = {};
  lying.links = fragment.links;
  lying.node_P_mm = fragment.node_P_mm;
  // The chain still knows how thick it was beyond the break.
  for (std::size_t n = 0; n <= lying.links; ++n) lying.radius_mm[n] = broken.radius_mm[broken.links + n];
  lying.strokes_since = strokes.strokes() > 0 ? 1 : 0;
}

void FileFragments::forgetUndone() noexcept {
  std::size_t kept = 0;
  for (std::size_t n = 0; n < count_; ++n)
    if (!of_[n].is_undone) of_[kept++] = of_[n];
  count_ = kept;
}

void FileFragments::count() noexcept {
  met_ = 0;
  for (std::size_t n = 0; n < count_; ++n) met_ += of_[n].is_met && !of_[n].is_undone;
}

std::size_t FileFragments::lying() const noexcept {
  std::size_t lying = 0;
  for (std::size_t n = 0; n < count_; ++n) lying += !of_[n].is_undone;
  return lying;
}

void FileFragments::follow(const StrokeHistory& strokes, bool restored) noexcept {
  constexpr auto kRing = static_cast<int>(StrokeHistory::kMaxStrokes);
  const std::size_t place = strokes.place(strokes.strokes() + StrokeHistory::kMaxStrokes - 1);
  int strokes_more = has_place_ ? static_cast<int>(place) - static_cast<int>(last_place_) : 0;
  if (strokes_more > kRing / 2) strokes_more -= kRing;
  if (strokes_more < -kRing / 2) strokes_more += kRing;
  last_place_ = place;
  has_place_ = true;
  if (strokes_more == 0 || count_ == 0) return;
  // A new stroke: what was undone cannot be redone.
  if (!restored && strokes_more > 0) forgetUndone();
  for (std::size_t n = 0; n < count_; ++n) {
    if (of_[n].was_before) continue;
    of_[n].strokes_since += strokes_more;
    if (restored) of_[n].is_undone = of_[n].strokes_since < 1;
  }
  count();
}

FileFragments::Nearest FileFragments::nearestOf(const Lying& fragment, const dvec3& at_mm) noexcept {
  Nearest nearest;
  for (std::size_t n = 0; n < fragment.links; ++n) {
    const dvec3 &from = fragment.node_P_mm[n], way = fragment.node_P_mm[n + 1] - from, to = at_mm - from;
    const double length_mm = std::sqrt(glm::dot(way, way));
    if (!(length_mm > 0.0)) continue;
    const dvec3 axis = way / length_mm;
    // Of a round cone the nearest circle lies where its side leans to.
    const double taper = (fragment.radius_mm[n] - fragment.radius_mm[n + 1]) / length_mm;
    const double along_mm = glm::dot(to, axis);
    const double aside_mm = std::sqrt(std::max(0.0, glm::dot(to, to) - along_mm * along_mm));
    const double lean_mm = aside_mm * taper / std::sqrt(1.0 - taper * taper);
    const double foot_mm = std::clamp(along_mm - lean_mm, 0.0, length_mm);
    const dvec3 away = to - foot_mm * axis;
    const double apart_mm = std::sqrt(glm::dot(away, away)), less_mm = fragment.radius_mm[n] - taper * foot_mm;
    if (apart_mm - less_mm >= nearest.apart_mm) continue;
    nearest.apart_mm = apart_mm - less_mm;
    // In its very middle there is no way out: up it is.
    nearest.away = apart_mm > 1e-6 ? away / apart_mm : -axis;
  }
  return nearest;
}

void FileFragments::press(const dvec3& at_mm, double radius_mm, SectionContact& contact) const noexcept {
  for (std::size_t n = 0; n < count_; ++n) {
    if (!of_[n].is_met || of_[n].is_undone) continue;
    const Nearest nearest = nearestOf(of_[n], at_mm);
    const double deep_mm = radius_mm - nearest.apart_mm;
    if (!(deep_mm > 0.0)) continue;
    contact.energy_Nmm += 0.5 * kMet_N_per_mm * deep_mm * deep_mm;
    contact.force_N += kMet_N_per_mm * deep_mm * nearest.away;
    contact.stiffness_N_per_mm += glm::outerProduct(kMet_N_per_mm * nearest.away, nearest.away);
    contact.normal_N += kMet_N_per_mm * deep_mm;
  }
}

bool FileFragments::overlaps(const Lying& fragment, const FileChain& chain, const ChainShape& shape) noexcept {
  for (std::size_t i = 1; i <= chain.links; ++i)
    if (nearestOf(fragment, shape.node_mm[i]).apart_mm < chain.radius_mm[i]) return true;
  return false;
}

void FileFragments::wake(const FileChain& chain, const ChainShape& shape) noexcept {
  if (met_ == count_) return;
  for (std::size_t n = 0; n < count_; ++n)
    if (!of_[n].is_met && !overlaps(of_[n], chain, shape)) of_[n].is_met = true;
  count();
}

void FileFragments::lookAgain(const FileChain& chain, const ChainShape& shape) noexcept {
  for (std::size_t n = 0; n < count_; ++n) of_[n].is_met = !overlaps(of_[n], chain, shape);
  count();
}

}  // namespace haptics

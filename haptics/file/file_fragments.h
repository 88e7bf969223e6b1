// What separated files have left in a tooth: round cones of steel that no file cuts, part of the wall that later files
// meet; there is a way past only beside them. One that still lies on the file it broke off is met once it is clear of
// it. A fragment belongs to the stroke in which the file broke: undone with it, redone with it; those that lay in the
// tooth from the beginning stay. The overlap of two round sections is a potential, k d^2 / 2. Frame P; mm, N. Servo
// thread: no allocation; 0.1 µs a section and fragment.
#pragma once

#include <cstdint>
#include <span>

#include "assets/metal_fragment.h"
#include "haptics/bone/stroke_history.h"
#include "haptics/file/file_in_canal.h"
#include "haptics/file/wall_contact.h"

namespace haptics {

class FileFragments {
 public:
  static constexpr std::size_t kMost = assets::kMostMetalFragments;  ///< the next ones vanish
  static constexpr double kMet_N_per_mm = 60.0;

  FileFragments() = default;
  /// With what earlier files have left: met from now on, and no stroke takes it back.
  explicit FileFragments(std::span<const assets::MetalFragment> before) noexcept;

  /// The wire as thick as it was: `radius_mm` from the break on.
  void leave(const FileFragment& fragment, const FileChain& broken, const StrokeHistory& strokes) noexcept;
  /// First in each tick; `restored`: strokes were undone or redone in it.
  void follow(const StrokeHistory& strokes, bool restored) noexcept;
  /// After each tick of a file: those that it no longer overlaps are met from now on.
  void wake(const FileChain& chain, const ChainShape& shape) noexcept;
  /// Another file, or put there without a way: it meets all that it does not overlap.
  void lookAgain(const FileChain& chain, const ChainShape& shape) noexcept;

  bool isMet() const noexcept { return met_ > 0; }
  std::size_t lying() const noexcept;
  /// Adds what a round section bears.
  void press(const glm::dvec3& at_mm, double radius_mm, SectionContact& contact) const noexcept;

 private:
  struct Lying {
    std::size_t links = 0;
    PerNode<glm::dvec3> node_P_mm{};
    PerNode<double> radius_mm{};
    int strokes_since = 0;    ///< 1: it broke in the newest
    bool was_before = false;  ///< of all strokes
    bool is_undone = false, is_met = false;
  };
  struct Nearest {
    double apart_mm = 1e9;  ///< of a point from its surface; negative inside
    glm::dvec3 away{0.0, 0.0, 1.0};
  };
  static Nearest nearestOf(const Lying& fragment, const glm::dvec3& at_mm) noexcept;
  static bool overlaps(const Lying& fragment, const FileChain& chain, const ChainShape& shape) noexcept;
  void forgetUndone() noexcept;
  void count() noexcept;

  std::array<Lying, kMost> of_{};
  std::size_t count_ = 0, met_ = 0, last_place_ = 0;
  bool has_place_ = false;
};

}  // namespace haptics

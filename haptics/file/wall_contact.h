// A section of a file, or its tip, against the live wall: energy, force and stiffness of the overlap along sixteen
// (tip: thirteen) rays. Energy k d^2 / 2 per ray, d its depth; the sum of d dA is the overlap's volume, so a
// conservative form of Agus' law (reference/sisters 1.3). Force = slope of the energy, so that a jammed file is a
// potential. Frame P; mm, N. Servo thread; no allocation; 0.1 to 1 µs.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "haptics/bone/solid_field.h"
#include "haptics/file/file_law.h"
#include "haptics/file/wall_kernels.h"

namespace haptics {

struct SectionPlace {
  glm::dvec3 centre_P_mm, axis;  ///< axis: unit, towards the tip, kept during a tick
  double radius_mm, length_mm;   ///< the length of file it stands for
};

struct SectionContact {
  double energy_Nmm = 0.0;
  double normal_N = 0.0;  ///< sum of the rays' forces, opposed ones too
  glm::dvec3 force_N{0.0};
  glm::dmat3 stiffness_N_per_mm{0.0};
};

/// Unit directions of the rays, from the axis out.
std::array<glm::dvec3, kRays> raysAbout(const glm::dvec3& axis) noexcept;

/// Depth of each ray, mm; false: none meets anything.
bool rayDepths(const FileLaw& law, const SolidField& wall, const SectionPlace& at,
               std::array<double, kRays>& depth_mm) noexcept;

void addSection(const FileLaw& law, const SolidField& wall, const SectionPlace& at, SectionContact& sum) noexcept;
/// The cap of 60 degrees about the axis; adds no normal force for friction.
void addTip(const FileLaw& law, const SolidField& wall, const SectionPlace& at, SectionContact& sum) noexcept;

}  // namespace haptics

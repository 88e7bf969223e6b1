// A sphere against a half-space: what a bur that is h deep shares with flat bone, and back from volume to depth.
// Lengths in mm, double, closed forms (reference/physics 2.1, 2.2). Any thread; under 0.5 µs.
// Not the sum over voxels (contact/overlap).
#pragma once

namespace haptics {

/// V = pi h^2 (R - h/3), h clamped to 0..2R.
double capVolume_mm3(double radius_mm, double depth_mm);

/// |M1| = pi/4 h^2 (2R - h)^2: first moment of the cap about the sphere's centre.
double capMoment_mm4(double radius_mm, double depth_mm);

/// The depth of the cap of this volume, 0..2R, to 1e-9 R: trigonometric root of the cubic, polished by Halley steps.
double capHeight_mm(double radius_mm, double volume_mm3);

/// The depth of a flat face whose *voxel sum* has this volume. Voxel spheres and a face that is one voxel soft smear
/// depth by sigma = 0.4 s (sigma^2 = s^2/12 + eta^2/5, reference/physics 0.6), which adds 0.504 s^2 (R - h) to
/// the volume. Solved with the smear itself (Gaussian), whose second-order term that is, so that the first touch comes
/// at depth 0 and with slope 1 and not, as the bare correction would have it, with an infinite slope at 0.35 sigma.
double equivalentDepth_mm(double radius_mm, double volume_mm3, double spacing_mm);

/// The same for a face as soft as it is. Where it lies along the voxels its softness hangs on where between two layers
/// it falls: none on a boundary, most through a layer's middle. A layer filled to the fraction f is off by
/// s^2 (f (1 - f) - 1/12) in sigma^2 (midpoint rule, exact to second order), so with `grey_mm3`, the sum of
/// overlap times w (1 - w), and the area A = dV/dh of the face:  sigma^2 = eta^2/5 - s^2/12 + s grey/A.
/// One voxel soft, grey/A is s/6 and this is the 0.4 s above; grey/A is taken as at most s/4, all one layer can have,
/// and as s/6 at first touch, fading to what is found between half a voxel and one and a half of depth.
double equivalentDepth_mm(double radius_mm, double volume_mm3, double grey_mm3, double spacing_mm);

}  // namespace haptics

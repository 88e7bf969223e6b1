// A sphere against a half-space: overlap of a bur h deep in flat bone, and back from volume to depth. mm, double,
// closed forms (reference/physics 2.1, 2.2). Any thread; under 0.5 µs. Sum over voxels: contact/overlap.
#pragma once

namespace haptics {

/// V = pi h^2 (R - h/3), h clamped to 0..2R.
double capVolume_mm3(double radius_mm, double depth_mm);

/// |M1| = pi/4 h^2 (2R - h)^2: first moment of the cap about the sphere's centre.
double capMoment_mm4(double radius_mm, double depth_mm);

/// Depth of the cap of this volume, 0..2R, to 1e-9 R: trigonometric root of the cubic, refined by Halley steps.
double capHeight_mm(double radius_mm, double volume_mm3);

/// Depth of a flat face, one voxel soft, whose *voxel sum* has this volume. Voxel spheres and the soft face smear depth
/// by sigma = 0.4 s (sigma^2 = s^2/12 + eta^2/5, reference/physics 0.6), which adds 0.504 s^2 (R - h) to the volume.
/// Solved with the Gaussian smear, so that contact begins at depth 0 with slope 1.
double equivalentDepth_mm(double radius_mm, double volume_mm3, double spacing_mm);

/// Sigma for a face of measured softness. A layer filled to the fraction f is off by s^2 (f (1 - f) - 1/12) in sigma^2
/// (midpoint rule), so with grey/A, the sum of overlap times w (1 - w) over the face's area A = dV/dh:
///   sigma^2 = eta^2/5 - s^2/12 + s grey/A;   one voxel soft: grey/A = s/6 and sigma = 0.4 s.
/// grey/A is limited to s/4, the most of one layer, and is s/6 at first touch, fading to the measured value between
/// half a voxel and one and a half of depth; `layers` is the depth in voxels.
double faceSmear_mm(double grey_per_area_mm, double layers, double spacing_mm);
/// equivalentDepth_mm with the softness of the face in the bur; `grey_mm3` as in SphereOverlap.
double equivalentDepth_mm(double radius_mm, double volume_mm3, double grey_mm3, double spacing_mm);

}  // namespace haptics

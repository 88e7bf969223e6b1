// Constants of the marks on soft tissue, for shaders and CPU kernels (soft_marks.h). Only #defines: C++ includes this
// file too. Chosen by eye on pictures at work scale.

#define SOFT_FAR 1e3f               // mm: no cut is near
#define SOFT_RIM_FROM 0.50f         // mm from a cut: full wound
#define SOFT_RIM_WIDTH 1.4f         // and where it ends
#define SOFT_WOUND_COLOUR 0.30f, 0.012f, 0.010f
#define SOFT_DEEP_FROM 0.3f         // mm from a cut: from here inwards it is darker
#define SOFT_DEEP_TO -0.9f
#define SOFT_DEEP_SHADE 0.4f
#define SOFT_WOUND_COVER 0.92f
#define SOFT_WOUND_ROUGHNESS 0.30f  // wet
#define SOFT_RED_TINT 0.92f, 0.40f, 0.38f  // of the albedo where tissue is reddened
#define SOFT_FARTHEST 40.0f         // exponent of a redness that is no longer seen

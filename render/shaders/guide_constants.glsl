// Colours and patterns of the guides on the bone, for shaders and CPU kernels. Only #defines: C++ includes this file too.
// Linear light; mm.

#define GUIDE_NEAR_COLOUR 0.66f, 0.11f, 0.0f     // hues of Okabe and Ito, "Color universal design" (2008)
#define GUIDE_MIDDLE_COLOUR 0.79f, 0.35f, 0.0f
#define GUIDE_FAR_COLOUR 0.87f, 0.77f, 0.06f
#define GUIDE_PLANNED_COLOUR 0.09f, 0.46f, 0.81f
#define GUIDE_RIM_COLOUR 0.0f, 0.08f, 0.30f
#define GUIDE_SHOWN_TO 3.2f
#define GUIDE_STRIPES_PER_MM 0.55f
#define GUIDE_DOTS_PER_MM 1.1f
#define GUIDE_FULL_COVER 0.85f
#define GUIDE_STRIPE_GAP_COVER 0.45f
#define GUIDE_DOT_COVER 0.80f
#define GUIDE_DOT_GAP_COVER 0.25f
#define GUIDE_BAND_END 0.07f        // half width of the dark line that ends a band
#define GUIDE_PLAN_COVER 0.42f
#define GUIDE_PLAN_RIM 0.14f
#define GUIDE_PLAN_RIM_COVER 0.9f
#define GUIDE_DARKEST 0.25f         // canal tube seen along its wall

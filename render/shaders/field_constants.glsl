// Constants of what covers the operated site, for shaders and CPU kernels (surgical_field.h). Only #defines: C++
// includes this file too. Chosen by eye on pictures at work scale; water: refractive index 1.33, reflectance 0.02.

#define FIELD_FARTHEST 60.0f        // exponent of a cover that is no longer seen

#define FIELD_WET_ROUGHNESS 0.13f
#define FIELD_WET_F0 0.036f         // film and bone below it
#define FIELD_WET_DARKENS 0.16f     // wet porous matter is darker
#define FIELD_FILM_PATCHES 0.9f     // unevenness of the film, by the tissue's mottling

#define FIELD_BLOOD_COLOUR 0.235f, 0.022f, 0.016f
#define FIELD_MARROW_BLEEDS 0.95f   // cover of cut marrow at blood 1
#define FIELD_BLOOD_FROM -0.16f     // mottling between which it covers
#define FIELD_BLOOD_TO 0.14f
#define FIELD_STREAKS 0.80f         // on cortex and tooth near the cut, at blood 1
#define FIELD_STREAKS_FROM -0.02f
#define FIELD_STREAKS_TO 0.24f

#define FIELD_DUST_COLOUR 0.86f, 0.83f, 0.77f
#define FIELD_DUST_ROUGHNESS 0.85f
#define FIELD_DUST_FROM -0.30f      // mottling and slope between which it lies
#define FIELD_DUST_TO 0.12f
#define FIELD_DUST_SLOPE 0.20f      // more on what faces up

#define FIELD_SPRAY_COLOUR 0.62f, 0.66f, 0.70f
#define FIELD_SPRAY_COVER 0.15f     // of the view at the middle of the site, at spray 1

// Hollows too narrow for the ambient map: fluid stands in them and scatters light.
#define FIELD_HOLLOW_FROM 0.60f     // share of the room that is hidden
#define FIELD_HOLLOW_TO 0.95f
#define FIELD_HOLLOW_COLOUR 0.30f, 0.062f, 0.046f
#define FIELD_HOLLOW_COVER 0.78f
#define FIELD_HOLLOW_AMBIENT 0.26f  // least light there
#define FIELD_HOLLOW_LAMP 0.30f

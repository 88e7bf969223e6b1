// How the finishes of the appearance field shine: roughness, reflectance at normal incidence, wrap. Only #defines of three
// numbers each, so that C++ can include this file too with its own vec3.

#define FINISH_MARROW vec3(0.42, 0.035, 0.15)
#define FINISH_DULL vec3(0.49, 0.042, 0.11)
#define FINISH_ENAMEL vec3(0.18, 0.055, 0.30)
#define COLOUR_DEPTH_VOXELS 0.7    // colour is read this far below the surface: partial volume at it makes all appearance like bone

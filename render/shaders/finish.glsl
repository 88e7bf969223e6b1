// How the finishes of the appearance field reflect: roughness, reflectance at normal incidence, wrap. Only #defines of
// three values each: C++ includes this file with its own vec3.

#define FINISH_MARROW vec3(0.42, 0.035, 0.15)
#define FINISH_DULL vec3(0.49, 0.042, 0.11)
#define FINISH_ENAMEL vec3(0.18, 0.055, 0.30)
#define COLOUR_DEPTH_VOXELS 0.7    // depth below the surface where colour is read, since partial volume at the surface looks like bone

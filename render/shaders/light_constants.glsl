// Constants of light, mesh materials, background and output, for shaders and CPU kernels. Only #defines: C++ includes
// this file too. Linear light; lengths in mm where stated.

#define LAMP_LIGHT 2.75f, 2.62f, 2.40f
#define SKY_LIGHT 0.300f, 0.315f, 0.33f
#define FLOOR_LIGHT 0.105f, 0.092f, 0.085f
#define LAMP_CONE_INNER 0.985f      // cosines between which the beam fades
#define LAMP_CONE_OUTER 0.86f
#define LAMP_CONE_DARK 0.25f        // to this share

// A curing lamp, about 460 nm.
#define CURING_LIGHT 0.10f, 0.80f, 7.0f
#define CURING_EDGE 0.75f           // of its radius, from where it fades
#define CURING_WRAP 0.4f            // enamel and composite scatter it
#define CURING_WHITE 0.25f          // of its light comes back whatever the colour of the surface

// Reflected surroundings: walls from floor to sky, a panel overhead, a strip of windows on either side.
#define WALL_FLOOR_SHARE 0.6f
#define WALL_LOW -0.5f
#define WALL_HIGH 0.7f
#define MIRROR_SOFT 0.04f           // softness of the edges, increasing with roughness
#define MIRROR_SOFT_ROUGH 0.7f
#define PANEL_EDGE 0.72f
#define PANEL_LIGHT 2.2f, 2.25f, 2.3f
#define STRIP_FROM 0.66f
#define STRIP_TO 0.86f
#define STRIP_LIGHT 1.0f, 1.05f, 1.1f
#define MIRROR_ROUGH_LOSS 0.55f

// Ambient specular, Lazarov 2013: slope and start over roughness.
#define SPECULAR_FIT_SLOPE -1.0f, -0.0275f, -0.572f, 0.022f
#define SPECULAR_FIT_START 1.0f, 0.0425f, 1.04f, -0.04f
#define SPECULAR_FIT_FALL -9.28f
#define SPECULAR_FIT_SCALE 1.04f

// Bounced ambient light, Jimenez et al. 2016: slope and start over albedo.
#define BOUNCE_A 2.0404f, -0.3324f
#define BOUNCE_B -4.7951f, 0.6417f
#define BOUNCE_C 2.7552f, 0.6903f

// Ambient occlusion and lamp shadow from the ambient map.
#define CONE_FIRST_CELLS 1.5f       // first sample along a cone: at least this many cells
#define CONE_FIRST_MM 1.2f          // and mm
#define CONE_SECOND 2.2f            // further samples, in distances to the first
#define CONE_THIRD 4.5f
#define CONE_SECOND_SHADE 0.85f
#define CONE_THIRD_SHADE 0.6f
#define CONE_TILT 0.70710678f
#define LAMP_SAMPLES 9
#define LAMP_STEP_GROWTH 1.4f
#define LAMP_LIFT 0.8f              // off the surface, in distances to the first sample
#define LAMP_CLEAR 0.15f
#define LAMP_BLOCKED 0.85f
#define LAMP_MIN 0.06f              // least share of the lamp in full shadow

// Meshes.
#define MIN_ROUGHNESS 0.06f
#define MESH_F0 0.04f
#define MESH_LIFT 0.5f              // mm off the surface, where its occlusion is sampled
#define RIM_BEHIND 2.0f             // mm in front of the site where the face window ends
#define RIM_WIDTH 2.5f              // mm of darker, redder cut edge around it
#define RIM_TINT 0.45f, 0.14f, 0.11f
#define SKIN_WRAP 0.35f
#define SKIN_F0 0.028f
#define GINGIVA_WRAP 0.30f
#define GINGIVA_F0 0.030f
#define GINGIVA_SCATTER 1.0f, 0.35f, 0.30f
#define STEEL_MIN_AMBIENT 0.45f     // steel in a cavity still reflects the opening
#define STEEL_MIN_LAMP 0.35f
#define INSIDE_AMBIENT 0.45f        // back faces
#define INSIDE_LAMP 0.35f

// The glass of a dental mirror: front-surface silver; breath and spray on it.
#define GLASS_KEEPS 0.93f
#define GLASS_FOG_COLOUR 0.42f, 0.45f, 0.48f

// Background.
#define BACKGROUND_FLOOR 0.010f, 0.0115f, 0.013f
#define BACKGROUND_SKY 0.040f, 0.044f, 0.048f
#define BACKGROUND_GLOW 0.022f
#define BACKGROUND_GLOW_REACH 0.45f
#define BACKGROUND_GLOW_TINT 0.9f, 1.0f, 1.08f

// Translucent tooth and bone.
#define DVR_OPAQUE 0.98f            // rays end at this opacity
#define DVR_SOLID 0.5f              // opacity at which the distance of the pixel is taken
#define DVR_FULL_GRADIENT 0.25f     // drop of the smoothed field over two voxels that counts as a surface
#define DVR_INNER_LAMBERT 0.45f     // Lambert factor of matter without a surface

#define SHOULDER_KNEE 0.70f         // linear up to here; above it rolls off towards white

#define EDGE_BEND 0.002f            // relative second difference of the inverse distance at an edge: 1 mm at 0.5 m

// Finishes of the appearance field: roughness, reflectance at normal incidence, wrap. C++ defines its own vec3.
#define FINISH_MARROW vec3(0.42, 0.035, 0.15)
#define FINISH_DULL vec3(0.49, 0.042, 0.11)
#define FINISH_ENAMEL vec3(0.18, 0.055, 0.30)
#define COLOUR_DEPTH_VOXELS 0.7    // colour is read this far below the surface, out of partial volume

// Guides on the bone: colours and patterns; mm.
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
#define GUIDE_HIDDEN_MM 0.05f       // a guide that far behind what is seen is drawn through it

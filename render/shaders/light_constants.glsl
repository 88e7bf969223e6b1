// Numbers of the light, the surfaces of the meshes, the background and the output, for the shaders and for the kernels
// of the CPU. Only #defines: both languages include this file. Linear light; lengths in mm where they say so.

#define LAMP_LIGHT 2.75f, 2.62f, 2.40f
#define SKY_LIGHT 0.300f, 0.315f, 0.33f
#define FLOOR_LIGHT 0.105f, 0.092f, 0.085f
#define LAMP_CONE_INNER 0.985f      // cosines between which the beam fades …
#define LAMP_CONE_OUTER 0.86f
#define LAMP_CONE_DARK 0.25f        // … to this

// What is mirrored: walls from floor to sky, a panel overhead, a strip of windows on either side.
#define WALL_FLOOR_SHARE 0.6f
#define WALL_LOW -0.5f
#define WALL_HIGH 0.7f
#define MIRROR_SOFT 0.04f           // softness of the edges, for a mirror and more for a rough surface
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

// Soft visibility from the map of crowding.
#define CONE_FIRST_CELLS 1.5f       // the first place along a cone, at least, in cells …
#define CONE_FIRST_MM 1.2f          // … and in mm
#define CONE_SECOND 2.2f            // the next, in lengths to the first
#define CONE_THIRD 4.5f
#define CONE_SECOND_SHADE 0.85f
#define CONE_THIRD_SHADE 0.6f
#define CONE_TILT 0.70710678f
#define LAMP_SAMPLES 9
#define LAMP_STEP_GROWTH 1.4f
#define LAMP_LIFT 0.8f              // off the surface, in lengths to the first place
#define LAMP_CLEAR 0.15f
#define LAMP_BLOCKED 0.85f
#define LAMP_MIN 0.06f             // what reaches the darkest place

// Meshes.
#define MIN_ROUGHNESS 0.06f
#define MESH_F0 0.04f
#define MESH_LIFT 0.5f              // mm off the surface, where its visibility is looked up
#define RIM_BEHIND 2.0f             // mm before the site where the window in the face ends
#define RIM_WIDTH 2.5f              // mm of darker, redder cut edge around it
#define RIM_TINT 0.45f, 0.14f, 0.11f
#define SKIN_WRAP 0.35f
#define SKIN_F0 0.028f
#define GINGIVA_WRAP 0.30f
#define GINGIVA_F0 0.030f
#define GINGIVA_SCATTER 1.0f, 0.35f, 0.30f
#define STEEL_MIN_AMBIENT 0.45f   // steel in a cavity still mirrors its bright mouth
#define STEEL_MIN_LAMP 0.35f
#define INSIDE_AMBIENT 0.45f        // of a mesh seen from behind
#define INSIDE_LAMP 0.35f

// The dark theatre behind everything.
#define BACKGROUND_FLOOR 0.010f, 0.0115f, 0.013f
#define BACKGROUND_SKY 0.040f, 0.044f, 0.048f
#define BACKGROUND_GLOW 0.022f
#define BACKGROUND_GLOW_REACH 0.45f
#define BACKGROUND_GLOW_TINT 0.9f, 1.0f, 1.08f

// Translucent tooth and bone.
#define DVR_OPAQUE 0.98f            // what lies behind is not looked for
#define DVR_SOLID 0.5f              // where so much light is stopped lies the distance of the image
#define DVR_FULL_GRADIENT 0.25f         // fall of the smoothed field over two voxels that counts as a surface
#define DVR_INNER_LAMBERT 0.45f     // how matter without a surface takes the lamp's light

#define SHOULDER_KNEE 0.70f         // up to here light is shown as it is; above it rolls off towards white

#define EDGE_BEND 0.002f            // bend of the inverse distance over three pixels that is an edge: 1 mm at half a metre

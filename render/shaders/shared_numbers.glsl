// Numbers that the shaders and C++ must agree on. Only #defines: both languages include this file.

#define BRICK_VOXELS 8           // edge of a brick in voxels, assets::kBrickVoxels
#define AMBIENT_CELL_VOXELS 2    // edge of a cell of the ambient map in voxels

#define EYE_BLOCK 0              // uniform blocks
#define VOLUME_BLOCK 1
#define PART_BLOCK 2
#define OUTPUT_BLOCK 3

#define SOLID_UNIT 0             // texture units
#define LABEL_UNIT 1
#define EMPTINESS_UNIT 2
#define AMBIENT_UNIT 3
#define SCENE_DISTANCE_UNIT 4
#define LEFT_EYE_UNIT 5
#define RIGHT_EYE_UNIT 6
#define SMOOTH_UNIT 7
#define LOOK_UNIT 8

#define POSITION_ATTRIBUTE 0     // vertex attributes
#define NORMAL_ATTRIBUTE 1
#define COLOUR_ATTRIBUTE 2

#define COLOUR_TARGET 0          // outputs of every scene pass
#define DISTANCE_TARGET 1

#define FINISH_SKIN 0            // how a mesh is shaded
#define FINISH_GUM 1
#define FINISH_INSTRUMENT 2

#define OUTPUT_LEFT 0            // what the output pass shows
#define OUTPUT_ANAGLYPH 1

// Constants shared by shaders and C++. Only #defines: both include this file.

#define BRICK_VOXELS 8           // edge of a brick in voxels, assets::kBrickVoxels
#define AMBIENT_CELL_VOXELS 2    // edge of a cell of the ambient map in voxels

#define EYE_BLOCK 0              // uniform blocks
#define VOLUME_BLOCK 1
#define PART_BLOCK 2
#define OUTPUT_BLOCK 3
#define TRANSFER_BLOCK 4
#define TOOL_BLOCK 5
#define SOFT_BLOCK 6

#define FRAGMENT_LIST 0          // storage buffers
#define FRAGMENT_HEADS_IMAGE 2   // images, after the targets

#define SOLID_UNIT 0             // texture units
#define LABEL_UNIT 1
#define EMPTINESS_UNIT 2
#define AMBIENT_UNIT 3
#define SCENE_DISTANCE_UNIT 4
#define LEFT_EYE_UNIT 5
#define RIGHT_EYE_UNIT 6
#define SMOOTH_UNIT 7
#define APPEARANCE_UNIT 8
#define LAYER_LIGHT_UNIT 9
#define LAYER_DISTANCE_UNIT 10
#define EDGE_MASK_UNIT 11
#define GUIDE_UNIT 12
#define INSET_UNIT 13
#define REFLECTED_LIGHT_UNIT 14
#define REFLECTED_DISTANCE_UNIT 15
#define PAINT_UNIT 16

#define POSITION_ATTRIBUTE 0     // vertex attributes
#define NORMAL_ATTRIBUTE 1
#define COLOUR_ATTRIBUTE 2

#define GLASS_ALPHA 2.0          // of a pixel that shows a mirror's glass; less by what lies over it
#define COLOUR_TARGET 0          // outputs of every scene pass
#define DISTANCE_TARGET 1

#define FINISH_SKIN 0            // how a mesh is shaded
#define FINISH_GINGIVA 1
#define FINISH_INSTRUMENT 2
#define FINISH_GUIDE 3
#define FINISH_TOOTH 4
#define FINISH_PIECE 5
#define FINISH_OBSTACLE 6
#define FINISH_GLASS 7           // of a mirror: steel where it reflects nothing
#define PART_CUT_BY_WINDOW 1     // bits: traits of a mesh part
#define PART_VEIL 2              // of the faded face only the nearest surface is drawn

#define DISPLAY_MONO 0           // display modes, render::DisplayMode
#define DISPLAY_QUAD_BUFFER 1
#define DISPLAY_TWO_WINDOWS 2
#define DISPLAY_SIDE_BY_SIDE 3
#define DISPLAY_SIDE_BY_SIDE_FULL 4
#define DISPLAY_TOP_BOTTOM 5
#define DISPLAY_TOP_BOTTOM_FULL 6
#define DISPLAY_FRAME_PACKING 7
#define DISPLAY_ROW_INTERLEAVED 8
#define DISPLAY_COLUMN_INTERLEAVED 9
#define DISPLAY_CHECKERBOARD 10
#define DISPLAY_ANAGLYPH 11
#define DISPLAY_ANAGLYPH_RED_CYAN 12

#define SOURCE_BLACK 0           // what a pixel of the output shows, render::PixelSource
#define SOURCE_LEFT 1
#define SOURCE_RIGHT 2
#define SOURCE_CYCLOPEAN 3
#define SOURCE_BOTH 4

#define VIEW_ISO 0               // how tooth and bone are drawn
#define VIEW_DVR 1
#define TISSUE_COUNT 20          // assets::kTissueCount
#define CAST_GROUP 8             // edge of a work group of the compute caster, px

#define TOOL_PARTS 4             // round parts of an instrument that shade the patient

#define SOFT_CUTS 64             // marks on soft tissue
#define SOFT_REDDENED 8

#define EDGE_SAMPLES 2           // along each edge of a pixel that antialiasing draws again

#define GUIDE_CLEARANCE 1        // guides on the bone, as bits
#define GUIDE_PLAN 2
#define GUIDE_LOW_MM -4.0f       // range of the guide field
#define GUIDE_HIGH_MM 12.0f

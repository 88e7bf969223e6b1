// Constants of the instrument's shade and of the ring of the gap, for shaders and CPU kernels. Only #defines: C++
// includes this file too. mm; linear light. Values chosen by eye.

#define TOOL_LAMP_SPREAD 0.10f      // width of the penumbra per mm of way, either side: a lamp of 20 cm at 1 m
#define TOOL_LAMP_SOFT 0.06f        // and at the least
#define TOOL_LAMP_MIN 0.10f         // least share of the lamp in full shade
#define TOOL_SHADE 0.85f            // of the room by matter that touches

#define RING_SPREAD 0.25f           // the ring is wider than the bur by this part of the gap
#define RING_HALF_WIDTH 0.17f
#define RING_REACH 2.5f             // along the way to the bur, off the nearest point, beside the radius
#define RING_COVER 0.8f
#define RING_NEAR_COLOUR 1.0f, 0.05f, 0.02f
#define RING_CLOSE_COLOUR 1.0f, 0.42f, 0.0f
#define RING_MIDDLE_COLOUR 0.80f, 0.85f, 0.10f
#define RING_FAR_COLOUR 0.05f, 0.40f, 1.0f

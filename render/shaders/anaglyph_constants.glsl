// Anaglyph colours: rows of the matrices from linear light of each eye to linear light of the screen. Only #defines:
// C++ includes this file too. Least-squares projection for an LCD and ordinary red-cyan filters: Dubois, "Conversion of
// a Stereo Pair to Anaglyph with the Least-Squares Projection Method" (2009). Rows of left and right sum to 1: white
// stays white.

#define DUBOIS_LEFT_RED    0.437,  0.449,  0.164
#define DUBOIS_LEFT_GREEN -0.062, -0.062, -0.024
#define DUBOIS_LEFT_BLUE  -0.048, -0.050, -0.017
#define DUBOIS_RIGHT_RED   -0.011, -0.032, -0.007
#define DUBOIS_RIGHT_GREEN  0.377,  0.761,  0.009
#define DUBOIS_RIGHT_BLUE  -0.026, -0.093,  1.234

#version 450
// Depth only, so that each visible triangle is lit once.
void main() {}

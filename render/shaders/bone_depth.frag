#version 450
// Depth alone: which triangles are seen, before any of them is lit.
void main() {}

// The dependency that is missing.
extern "C" int standInPart() { return 1; }

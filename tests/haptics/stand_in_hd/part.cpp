// What another library needs and does not find.
extern "C" int standInPart() { return 1; }

// A library with a missing dependency, like the vendor's on a fresh Debian.
extern "C" int standInPart();
extern "C" int hdInitDevice() { return standInPart(); }

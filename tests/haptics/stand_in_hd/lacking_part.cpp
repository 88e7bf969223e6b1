// A library whose part is not where the linker looks, as with the vendor's on a fresh Debian.
extern "C" int standInPart();
extern "C" int hdInitDevice() { return standInPart(); }

// Work of the rest of the operation: pieces beside a slow and obvious twin in one run, ways out beside what must go.
//   haptics_extraction_bench            all parts
//   haptics_extraction_bench elevator   an elevator between a tooth and its crest: whole ticks
//   haptics_extraction_bench ligament   a piece in its socket: one sum, whole ticks
//   haptics_extraction_bench pieces     pieces of a tooth and the bridge between them
//   haptics_extraction_bench site       a tooth as a body: memory, the move of a block, ready for forceps
//   haptics_extraction_bench way-out    whether a piece can come out, and what is in its way
// CPU time of this thread; only ratios are comparable between machines.
#include <cstdio>
#include <string_view>

#include "tests/bench/extraction_parts.h"

int main(int argc, char** argv) {
  const std::string_view wanted = argc > 1 ? argv[1] : "";
  bool found = false;
  for (const auto& part : bench::kExtractionParts) {
    if (!wanted.empty() && wanted != part.name) continue;
    part.run();
    found = true;
  }
  if (!found) std::fprintf(stderr, "haptics_extraction_bench: no part of this name\n");
  return found ? 0 : 2;
}

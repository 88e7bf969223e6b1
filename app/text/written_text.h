// A text into an output file, all of it or nothing, in place at the end. Any thread; waits for the disk.
#pragma once

#include <fstream>
#include <string>

#include "assets/load_error.h"
#include "assets/output_file.h"

namespace app {

/// Throws LoadError, leaving the target as it was: no room, or the disk fails.
inline void writeText(assets::OutputFile& file, const std::string& text) {
  std::ofstream out(file.temporaryPath(), std::ios::binary);
  out << text;
  out.close();
  if (!out) throw assets::LoadError("can not write " + file.path() + ": the disk is full or fails, make room there");
  file.commit();
}

}  // namespace app

// A program with two commands, to test what is generated from its help.
#pragma once

#include <memory>
#include <string>

#include "app/text/command_line.h"

namespace app {

struct SampleProgram {
  CommandLine program{"An operation", "1.2"};
  std::string patient, out, mode = "iso";
  int most = 8;
  bool quick = false;

  SampleProgram() {
    CommandLine& cut = program.command("cut", "Cuts - .what is there\\");
    cut.option("patient", patient, "Whom").required();
    cut.option("--out", out, "Where to").required().valueNamed("FILE");
    cut.option("--mode", mode, "How it looks").oneOf({"iso", "dvr"}).showsDefault();
    cut.flag("-q,--quick", quick, "In a hurry");
    cut.footer(".a line\n'another");
    CommandLine& close = program.command("close", "Closes");
    close.requireCommand();
    close.command("stitch", "With thread").option("--most", most, "Stitches").wholeFrom(1, 20).showsDefault();
  }
};

}  // namespace app

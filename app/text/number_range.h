// A check for numbers on the command line that, unlike the library's own, refuses what is not a number. Start-up only.
#pragma once

namespace CLI {
class Validator;
}

namespace app {

/// Accepts low..high, both included; otherwise the option's error says "give a number from low to high".
CLI::Validator numberRange(double low, double high);

}  // namespace app

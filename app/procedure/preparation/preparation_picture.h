// A preparation as a picture for people: from the bite and from its four sides in colours of how far it lies from the
// ideal (blue: cut too deep, red: left too high), and sections from mesial to distal and from cheek to tongue with what
// was taken, what is left, and the ideal's outline. Any one thread; some 0.3 s.
#pragma once

#include "app/procedure/preparation/preparation_outcomes.h"
#include "render/image.h"

namespace app {

render::Image preparationPicture(const PreparationMeasure& measure, const BoxBytes& made,
                                 const PreparationOutcomes& outcomes);

}  // namespace app

// The bar of colours below a picture that shows amounts.
#pragma once

#include "filigree/report/drawing.h"

#include <string>
#include <vector>

namespace filigree::report {

struct ColourScale {
    struct Mark {
        double at = 0;  // along the bar, 0..1
        std::string text;
    };
    std::string title;            // what is shown, with its unit
    std::vector<Colour> colours;  // from the left, evenly spaced, blended between; at least two
    std::vector<Mark> marks;      // rising
    std::string note{};           // below; empty for none
};

// The colour at a place along the bar, 0..1.
Colour colourAt(const ColourScale& scale, double place);

// Narrow enough for phones by default.
Drawing layOut(const ColourScale& scale, double width = 340);

}  // namespace filigree::report

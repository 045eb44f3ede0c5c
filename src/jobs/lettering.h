// Text on a canvas in a built-in face, so that pictures need no font of the machine's.
#pragma once

#include "filigree/report/drawing.h"

#include "jobs/canvas.h"

#include <string_view>

namespace filigree::jobs {

// How wide drawText sets a text of `size` pixels (em).
double letteringWidth(std::string_view text, double size);

// Draws ASCII text from the baseline point `at`; any other character shows as '?'. `upward` turns it to read
// from bottom to top.
void drawText(Canvas& canvas, std::string_view text, Pixel at, double size, report::Anchor anchor,
              Colour colour, bool bold = false, bool upward = false);

// A drawing at `scale` pixels a unit on a light background.
Canvas paint(const report::Drawing& drawing, double scale);

}  // namespace filigree::jobs

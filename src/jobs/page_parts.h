// What the pages of several verbs share.
#pragma once

#include "filigree/core/result.h"
#include "filigree/report/page.h"
#include "filigree/scene/scene.h"

#include "jobs/canvas.h"

#include <string>
#include <string_view>
#include <vector>

namespace filigree::jobs {

// Of a method, the same in every chart; neighbours in size stay apart.
report::Colour methodColour(std::string_view method);

// As a PNG inside the page; `alt` says what it shows.
Result<report::Picture> pictureOf(const Canvas& canvas, const std::string& alt);
Result<report::Picture> pictureOf(const scene::ColourImage& image, const std::string& alt);

// Adds a section with the notes, if there are any.
void addNotes(const std::vector<std::string>& notes, report::Page& page);

// Rows of a name and a value each.
report::Table factTable(const std::string& caption, const std::string& command,
                        std::vector<std::vector<report::Cell>> rows);

}  // namespace filigree::jobs

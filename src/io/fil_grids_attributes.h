// The sections of attributes in a .fil of grids.
#pragma once

#include "filigree/io/fil_grids.h"

#include "io/fil_sections.h"

namespace filigree::io {

// Takes what there is of them into `to`, whose table is there and checked.
Status readGridAttributes(FilSections& sections, uint32_t looseVertices, FilGrids& to);

}  // namespace filigree::io

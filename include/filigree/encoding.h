// Micromaps as the bytes to trace with: seven encodings, their readers, and fewer bytes than they need.
//
//     const std::vector<uint8_t> flat(micromap::flatBytes(4, micromap::Format::fourState), 0x1b);
//     const auto map = micromap::quadtreeFromFlat(flat, 4, micromap::Format::fourState);
//     const std::vector<micromap::QuadtreeView> maps{map.view()};
//     const auto set = encoding::encode(encoding::Encoding::sdag, maps, micromap::Format::fourState);
//     const auto reader = encoding::openReader(encoding::viewOf(*set));
//     const micromap::State state = (*reader)->at(0, 0.25F, 0.5F);
#pragma once

#include "filigree/encoding/bitmask.h"
#include "filigree/encoding/dag.h"
#include "filigree/encoding/encode.h"
#include "filigree/encoding/encoded_set.h"
#include "filigree/encoding/flat.h"
#include "filigree/encoding/gruen.h"
#include "filigree/encoding/indexed_tree.h"
#include "filigree/encoding/lossy.h"
#include "filigree/encoding/map_reader.h"
#include "filigree/encoding/one_bit.h"
#include "filigree/encoding/sdag.h"
#include "filigree/encoding/tree.h"

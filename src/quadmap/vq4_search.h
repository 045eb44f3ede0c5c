#pragma once

#include "quadmap/vq4_words.h"

namespace filigree::quadmap {

// How far a search for transforms and codebook goes.
struct Effort4 {
    unsigned beam = 1;           // books that are followed as groups join
    unsigned tries = 8;          // transforms of a joining group that get a book of their own
    unsigned passes = 1;         // times round the words while groups join
    unsigned perturbations = 0;  // changes tried at the end
};

// Same demand and effort, same book.
Book4 searchVq4(const Demand4& demand, const Effort4& effort);

}  // namespace filigree::quadmap

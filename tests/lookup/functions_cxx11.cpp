#define FUNCTIONS lookup_functions_cxx11
#define COMPILER "C++11"
#include "functions.inc"

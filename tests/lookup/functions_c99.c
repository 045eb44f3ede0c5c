#define FUNCTIONS lookup_functions_c99
#define COMPILER "C99"
#include "functions.inc"

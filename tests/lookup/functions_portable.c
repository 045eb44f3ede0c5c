#define FILIGREE_LOOKUP_LITTLE_ENDIAN 0
#define FUNCTIONS lookup_functions_portable
#define COMPILER "C99, loads byte by byte"
#include "functions.inc"

// What the shared library shows.
#pragma once

// On every public declaration whose definition stands in a source file: functions, and classes with such
// members or with virtual functions. All else is hidden (-fvisibility=hidden).
#if defined(_WIN32)
#define FILIGREE_API
#else
#define FILIGREE_API __attribute__((visibility("default")))
#endif

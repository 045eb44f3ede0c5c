// What every room stands on: Result and Error, executors, progress and cancelling, files and bytes.
//
// Work that may fail gives a Result, whose error is one line for a person. Work that may take long takes an
// Executor to run on and a ProgressSink, which also says when to stop.
//
//     std::atomic<bool> stop = false;
//     FunctionProgress progress([](const ProgressReport& report) { std::cout << report.done << '\n'; },
//     &stop); const std::unique_ptr<Executor> executor = makeThreadedExecutor(0); const
//     Result<std::vector<uint8_t>> bytes = readFile("leaf.png"); if (!bytes) std::cerr <<
//     bytes.error().message << '\n';
#pragma once

#include "filigree/core/api.h"
#include "filigree/core/bits.h"
#include "filigree/core/bounded.h"
#include "filigree/core/box.h"
#include "filigree/core/bytes.h"
#include "filigree/core/executor.h"
#include "filigree/core/file.h"
#include "filigree/core/mapped_file.h"
#include "filigree/core/progress.h"
#include "filigree/core/result.h"
#include "filigree/core/stage.h"
#include "filigree/core/target.h"
#include "filigree/core/vec3.h"

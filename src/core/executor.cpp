#include "filigree/core/executor.h"

#include "core/serial_executor.h"

namespace filigree {

const Executor& serialExecutor() {
    static const SerialExecutor executor;
    return executor;
}

}  // namespace filigree

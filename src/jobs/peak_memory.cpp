#include "jobs/peak_memory.h"

#include <fstream>
#include <string>

namespace filigree::jobs {

// Not getrusage: its figure begins with that of the program that started this one.
uint64_t peakMemory() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        uint64_t kibibytes = 0;
        if (word == "VmHWM:" && status >> kibibytes) return kibibytes * 1024;
    }
    return 0;
}

}  // namespace filigree::jobs

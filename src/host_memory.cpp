#include "host_memory.h"

#include <fstream>
#include <limits>
#include <string>

namespace wavepath {

std::size_t available_memory() {
    std::ifstream stream("/proc/meminfo");  // "MemAvailable:   22630400 kB"
    std::string key;
    std::size_t kibibytes = 0;
    while (stream >> key) {
        if (key == "MemAvailable:" && stream >> kibibytes) return kibibytes << 10U;
        stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return std::numeric_limits<std::size_t>::max();
}

}  // namespace wavepath

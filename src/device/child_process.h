// This program, run once more as a child that may crash or hang, and the lines it reports.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace wavepath {

struct ChildOutput {
    std::vector<std::string> lines;  // the last one may be cut short by a crash
    std::string failure;             // e.g. "crashes (signal 11)"; empty: the child ended well
};

// Runs this executable with `arguments`, its standard streams closed to drivers that print, and
// kills it at `limit`.
ChildOutput run_self(const std::vector<std::string>& arguments, std::chrono::seconds limit);

// The child's end. One for the process.
class LineWriter {
  public:
    LineWriter();
    void write(const std::string& line) const;
};

}  // namespace wavepath

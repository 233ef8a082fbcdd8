// Words of a shell's command line.
#pragma once

#include <string>

namespace wavepath {

// `word` as a POSIX shell has to be given it.
std::string shell_word(const std::string& word);

}  // namespace wavepath

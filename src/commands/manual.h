// The manual page and the shell completion, written from the option table itself so that neither
// can fall behind it.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace wavepath {

// The manual page of `app` and its subcommands, in man(7) macros. Hidden options and commands
// (group "") are left out.
std::string man_page(const CLI::App& app);

// A bash script that completes the command line of `app`: subcommands, options, the values of
// options that have a fixed choice, and file names.
std::string bash_completion(const CLI::App& app);

}  // namespace wavepath

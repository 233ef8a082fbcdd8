// `wavepath diff`: how far two pictures are from one another, and whether it is more than noise.
#pragma once

namespace CLI {
class App;
}

namespace wavepath {

void add_diff_command(CLI::App& app);

// Thrown when all has been said; main answers with exit status 3.
struct ExpectationsDiffer {};

}  // namespace wavepath

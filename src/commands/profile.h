// `wavepath profile`: where the time of a render goes, kernel by kernel.
#pragma once

namespace CLI {
class App;
}

namespace wavepath {

void add_profile_command(CLI::App& app);

}  // namespace wavepath

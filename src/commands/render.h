// `wavepath render`: a scene in, pictures out.
#pragma once

namespace CLI {
class App;
}

namespace wavepath {

void add_render_command(CLI::App& app);

}  // namespace wavepath

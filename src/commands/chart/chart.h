// `wavepath chart`: error against time and against samples, of any settings on any scene.
#pragma once

namespace CLI {
class App;
}

namespace wavepath {

void add_chart_command(CLI::App& app);

}  // namespace wavepath

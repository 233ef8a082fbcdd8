// `wavepath devices`: what OpenCL has to offer here.
#pragma once

namespace CLI {
class App;
}

namespace wavepath {

void add_devices_command(CLI::App& app);

}  // namespace wavepath

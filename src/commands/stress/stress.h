// `wavepath stress`: every estimator in the situations in which it lives or dies.
#pragma once

namespace CLI {
class App;
}

namespace wavepath {

void add_stress_command(CLI::App& app);

}  // namespace wavepath

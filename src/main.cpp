#include "commands/devices.h"
#include "commands/diff.h"
#include "commands/interrupt.h"
#include "commands/manual.h"
#include "commands/outputs.h"
#include "commands/profile.h"
#include "commands/render.h"
#include "commands/stress/stress.h"
#include "device/device.h"
#include "device/device_probe.h"
#include "device/opencl.h"
#include "error.h"

#include <fcntl.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr int exit_failure = 1;
constexpr int exit_cut = 2;
constexpr int exit_differ = 3;
constexpr int exit_signalled = 128;  // plus the signal's number, as in a shell

constexpr const char* notes =
    "Exit status: 0 done; 1 an error, said in one line on standard error; 2 the picture is "
    "written, but\n"
    "paths without end were cut and their light is missing; 3 pictures differ (diff); 130 "
    "interrupted\n"
    "by Ctrl-C, 129 by SIGHUP, 143 by SIGTERM, 152 by SIGXCPU: the picture is written with the "
    "samples\n"
    "taken so far.\n"
    "\n"
    "Environment: OCL_ICD_VENDORS, which OpenCL drivers are seen; POCL_MAX_PTHREAD_COUNT, the "
    "cores\n"
    "that PoCL uses; WAVEPATH_KERNELS, a folder of kernels to use instead of the built-in ones;\n"
    "XDG_CACHE_HOME, where compiled kernels are kept.";

// Lets CLI11 answer a wrong command line in the one-line form of every other error.
int usage_error(const CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    std::string command;
    for (const CLI::App* sub : app.get_subcommands()) command = sub->get_name() + " ";
    std::string what = error.what();
    const std::vector<std::string> rest = app.remaining();
    if (command.empty() && !rest.empty() && !rest.front().starts_with('-'))
        what = rest.front() + " is no command: render, profile, diff, stress or devices";
    constexpr std::string_view unconverted = "Could not convert: ";  // then: --option = value
    if (what.starts_with(unconverted)) what = what.substr(unconverted.size()) + ": not a number";
    spdlog::error("{}; see wavepath {}--help", what, command);
    return exit_failure;
}

// A file opened in place of a closed standard stream would receive what is said there. In the wrong
// direction, so that reading and writing fail as they would have.
void occupy_standard_streams() {
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(fd, F_GETFD) < 0) open("/dev/null", (fd == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

void add_commands(CLI::App& app) {
    wavepath::add_render_command(app);
    wavepath::add_devices_command(app);
    wavepath::add_profile_command(app);
    wavepath::add_diff_command(app);
    wavepath::add_stress_command(app);
}

int run_command_line(int argc, char** argv) {
    if (wavepath::run_device_probe(argc, argv)) return 0;
    spdlog::set_default_logger(spdlog::stderr_color_st("wavepath"));
    spdlog::set_pattern("%^%l%$: %v");

    CLI::App app("Wavefront path tracer on OpenCL: glTF in, OpenEXR out", "wavepath");
    app.set_version_flag("--version", WAVEPATH_VERSION);
    app.footer(notes);
    app.require_subcommand(0, 1);
    std::string completion;
    bool manual = false;
    app.add_flag("--man", manual, "Print the manual page")->group("");
    app.add_option("--completion", completion, "Print the completion script of a shell")
        ->check(CLI::IsMember({"bash"}))
        ->group("");
    add_commands(app);
    try {
        wavepath::prepare_environment();
        app.parse(argc, argv);
        if (manual)
            std::fputs(wavepath::man_page(app).c_str(), stdout);
        else if (!completion.empty())
            std::fputs(wavepath::bash_completion(app).c_str(), stdout);
        else if (app.get_subcommands().empty()) {
            spdlog::error(
                "no command given: render, profile, diff, stress or devices; see wavepath --help");
            return exit_failure;
        }
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            throw wavepath::Error(
                "standard output: cannot be written: {}; what was printed is not whole",
                std::strerror(errno));
    } catch (const CLI::ParseError& error) {
        return usage_error(app, error);
    } catch (const wavepath::PathsCut&) {
        return exit_cut;
    } catch (const wavepath::ExpectationsDiffer&) {
        return exit_differ;
    } catch (const wavepath::Interrupted& interrupted) {
        return exit_signalled + interrupted.signal;
    } catch (const wavepath::OutputFailed&) {
        return exit_failure;
    } catch (const std::bad_alloc&) {
        spdlog::error(
            "not enough memory; use a smaller --size or scene, or raise the limit (ulimit -v)");
        return exit_failure;
    } catch (const cl::Error& error) {
        spdlog::error(
            "OpenCL: {} failed with code {}; `wavepath devices` tells what this device can do",
            error.what(), error.err());
        return exit_failure;
    } catch (const std::exception& error) {
        spdlog::error("{}", error.what());
        return exit_failure;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    occupy_standard_streams();
    try {
        return run_command_line(argc, argv);
    } catch (const std::exception& error) {  // before there is a logger, or of the logger
        std::fprintf(stderr, "error: %s\n", error.what());
        return exit_failure;
    }
}

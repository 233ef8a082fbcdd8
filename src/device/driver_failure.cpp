#include "device/driver_failure.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

namespace wavepath {

namespace {

constexpr std::array crashes{SIGABRT, SIGSEGV, SIGBUS, SIGILL, SIGFPE};

// Made beforehand, for a signal handler must not allocate, and never freed, for the program may end
// at any time. Null: no guard lives.
const std::string* last_words = nullptr;

void say_last_words() {
    const std::string* words = std::exchange(last_words, nullptr);
    if (words == nullptr) return;
    [[maybe_unused]] const auto written = write(STDERR_FILENO, words->data(), words->size());
}

void on_crash(int) {
    say_last_words();
    _exit(1);
}

// That PoCL writes for the chain [byte], by a good margin: its bitcode takes 1 MiB.
constexpr rlim_t largest_kernel_file = 4U << 20U;

// As PoCL 3.1 finds it (lib/CL/pocl_cache.c).
std::filesystem::path pocl_cache_folder() {
    if (const char* named = std::getenv("POCL_CACHE_DIR")) return named;
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"))
        return std::filesystem::path(xdg) / "pocl" / "kcache";
    if (const char* home = std::getenv("HOME"))
        return std::filesystem::path(home) / ".cache" / "pocl" / "kcache";
    return "/tmp/pocl/kcache";
}

}  // namespace

std::string pocl_cache_advice() {
    rlimit files{};
    if (getrlimit(RLIMIT_FSIZE, &files) == 0 && files.rlim_cur < largest_kernel_file)
        return fmt::format(
            "files may hold no more than {} KiB here, and its kernels take up to {}: raise ulimit "
            "-f",
            files.rlim_cur / 1024, largest_kernel_file / 1024);
    const char* cache = std::getenv("POCL_KERNEL_CACHE");
    return fmt::format(
        "its kernel cache {} may be damaged or not writable (full disk): delete it, name a folder "
        "elsewhere by POCL_CACHE_DIR{}; or memory or processes run out (ulimit -v, -u)",
        pocl_cache_folder().string(),
        cache && std::string_view(cache) == "0" ? "" : ", or go without by POCL_KERNEL_CACHE=0");
}

DriverFailureGuard::DriverFailureGuard() {
    static std::string& words = *new std::string;
    words = fmt::format(
        "error: the OpenCL driver failed and ended the program; if it is PoCL, {}; else try "
        "another --device\n",
        pocl_cache_advice());
    static const int registered = std::atexit(say_last_words);  // LLVM exits where a disk is full
    static_cast<void>(registered);
    last_words = &words;
    struct sigaction action {};
    action.sa_handler = on_crash;
    for (std::size_t i = 0; i < crashes.size(); ++i) sigaction(crashes[i], &action, &before_[i]);
}

DriverFailureGuard::~DriverFailureGuard() {
    for (std::size_t i = 0; i < crashes.size(); ++i) sigaction(crashes[i], &before_[i], nullptr);
    last_words = nullptr;
}

}  // namespace wavepath

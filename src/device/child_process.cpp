#include "device/child_process.h"

#include "error.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <sstream>

namespace wavepath {

namespace {

constexpr int report_fd = 3;  // the child's end of the pipe

// Starts this executable with its reports going to `write_end`.
pid_t spawn_self(const std::vector<std::string>& arguments, int write_end) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, write_end, report_fd);

    std::vector<std::string> words = {"wavepath"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    pid_t child = 0;
    const int failed = posix_spawn(&child, "/proc/self/exe", &files, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (failed != 0)
        throw Error(
            "/proc/self/exe: cannot be started: {}; is /proc mounted?", std::strerror(failed));
    return child;
}

// Reads until all writers have closed the pipe; false where that is not so at `limit`.
bool read_all(int fd, std::chrono::seconds limit, std::string& text) {
    const auto deadline = std::chrono::steady_clock::now() + limit;
    while (true) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
            deadline - std::chrono::steady_clock::now());
        if (left.count() <= 0) return false;
        pollfd waiting{fd, POLLIN, 0};
        if (poll(&waiting, 1, static_cast<int>(left.count())) <= 0) continue;
        char buffer[4096];
        const ssize_t bytes = read(fd, buffer, sizeof(buffer));
        if (bytes == 0) return true;
        if (bytes > 0) text.append(buffer, static_cast<std::size_t>(bytes));
    }
}

}  // namespace

ChildOutput run_self(const std::vector<std::string>& arguments, std::chrono::seconds limit) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw Error("no pipe for a child process: {}", std::strerror(errno));
    pid_t child = 0;
    try {
        child = spawn_self(arguments, ends[1]);
    } catch (...) {
        close(ends[0]);
        close(ends[1]);
        throw;
    }
    close(ends[1]);
    std::string text;
    const bool complete = read_all(ends[0], limit, text);
    close(ends[0]);
    kill(child, SIGKILL);  // no effect on a child that has ended, whose status is kept
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }

    ChildOutput output;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) output.lines.push_back(line);
    if (!complete)
        output.failure = fmt::format("does not answer within {} s", limit.count());
    else if (WIFSIGNALED(status))
        output.failure = fmt::format("crashes (signal {})", WTERMSIG(status));
    else if (WEXITSTATUS(status) != 0)
        output.failure = fmt::format("ends the process (status {})", WEXITSTATUS(status));
    return output;
}

LineWriter::LineWriter() {
    fcntl(
        report_fd, F_SETFD,
        FD_CLOEXEC);  // a compiler that a driver starts does not keep the pipe open
}

void LineWriter::write(const std::string& line) const {
    const std::string text = line + '\n';
    // A line is shorter than PIPE_BUF as a rule, so one write() takes it; the parent skips what
    // does not parse.
    if (::write(report_fd, text.data(), text.size()) < 0) _exit(1);  // nobody listens any more
}

}  // namespace wavepath

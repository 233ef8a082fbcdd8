#include "device/program.h"

#include "device/binary_cache.h"
#include "device/embedded_kernels.h"
#include "error.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

namespace wavepath {

namespace {

// Where a kernel file is said to be: on disk if WAVEPATH_KERNELS is set, and in messages and #line.
std::string kernel_path(const std::string& name) {
    const char* folder = std::getenv("WAVEPATH_KERNELS");
    return (folder != nullptr ? std::string(folder) : "kernels") + "/" + name;
}

std::optional<std::string> file_in_folder(const std::string& folder, const std::string& name) {
    if (!std::filesystem::is_directory(folder))
        throw Error(
            "WAVEPATH_KERNELS={}: no such folder; name a folder of kernel files, or unset it",
            folder);
    const std::string path = folder + "/" + name;
    if (!std::filesystem::is_regular_file(path)) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(file), {});
    if (!file) throw Error("{}: cannot be read; check its permissions", path);
    return text;
}

std::optional<std::string> embedded_file(const std::string& name) {
    std::optional<std::string> text;
    for (const EmbeddedChunk& chunk : embedded_chunks()) {
        if (chunk.file != name) continue;
        if (!text) text = "";
        *text += chunk.text;
    }
    return text;
}

std::optional<std::string> find_kernel_file(const std::string& name) {
    const char* folder = std::getenv("WAVEPATH_KERNELS");
    return folder != nullptr ? file_in_folder(folder, name) : embedded_file(name);
}

std::string quoted(const std::string& path) {
    std::string text = "\"";
    for (const char c : path) {
        if (c == '"' || c == '\\') text += '\\';
        text += c;
    }
    return text + '"';
}

// Shared headers tell the two languages apart by #ifdef __cplusplus; what they include for C++ is
// no kernel file.
class HostOnlyLines {
  public:
    // Whether C++ alone sees `line`. To be asked for every directive of a file, in order.
    bool contain(const std::string& line) {
        static const std::regex directive(R"(^\s*#\s*(ifdef\s+__cplusplus\b|if|else|elif|endif))");
        std::smatch match;
        if (!std::regex_search(line, match, directive)) return host_depth_ != 0;
        const std::string word = match[1];
        if (word.starts_with("if")) {
            ++depth_;
            if (host_depth_ == 0 && word != "if") host_depth_ = depth_;
            return host_depth_ != 0;
        }
        if (depth_ == host_depth_) host_depth_ = 0;
        if (word == "endif") --depth_;
        return host_depth_ != 0;
    }

  private:
    int depth_ = 0;
    int host_depth_ =
        0;  // nesting depth of the #ifdef __cplusplus around the line; 0: there is none
};

// Appends files to a source, each once, with #line before and after.
class Assembler {
  public:
    explicit Assembler(std::string source) : source_(std::move(source)) {}

    void add(const std::string& name, const std::string& text) {
        if (!added_.insert(name).second) return;
        static const std::regex directive(R"re(^\s*#\s*(?:include\s*"([^"]+)"|pragma\s+once))re");
        const std::string path = kernel_path(name);
        source_ += fmt::format("#line 1 {}\n", quoted(path));
        std::istringstream lines(text);
        HostOnlyLines host_only;
        std::smatch match;
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            const bool is_directive =
                line.find_first_not_of(" \t") == line.find('#') && !line.empty();
            if (!is_directive || host_only.contain(line) ||
                !std::regex_search(line, match, directive)) {
                source_ += line + '\n';
                continue;
            }
            if (!match[1].matched) {
                source_ += '\n';  // #pragma once: done here, and compilers warn of it in what is
                                  // one file to them
                continue;
            }
            const auto included = find_kernel_file(match[1]);
            if (!included)
                throw Error(
                    "{}:{}: #include \"{}\": there is no such kernel file; paths start at the "
                    "kernel folder",
                    path, number, match[1].str());
            add(match[1], *included);
            source_ += fmt::format("#line {} {}\n", number + 1, quoted(path));
        }
    }

    const std::string& source() const { return source_; }

  private:
    std::string source_;
    std::set<std::string> added_;
};

// The first error of a log in clang's form, which PoCL, Mesa, Intel, AMD and NVIDIA share up to the
// order of "error:" and place: "kernels/a.cl:7:44: error: what" or "error: kernels/a.cl:7:44:
// what".
std::string first_error(const std::string& log) {
    static const std::regex place_first(R"((\S+:\d+:\d+: )(?:fatal )?error: (.*))");
    static const std::regex error_first(R"(error: (\S+:\d+:\d+: )(.*))");
    std::istringstream lines(log);
    std::smatch match;
    for (std::string line; std::getline(lines, line);) {
        line.resize(
            std::min(line.size(), std::size_t{1000}));  // std::regex recurses for each character
        if (std::regex_search(line, match, place_first) ||
            std::regex_search(line, match, error_first))
            return match[1].str() + match[2].str();
    }
    return "the kernels do not build";
}

std::string build_log(const cl::Program& program, const Device& device) {
    return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.device);
}

bool builds(cl::Program& program, const Device& device, const std::string& options) {
    try {
        program.build(device.device, options.c_str());
        return true;
    } catch (const cl::Error&) {
        return false;
    }
}

cl::Program from_binary(
    const Device& device, const std::vector<unsigned char>& binary, const std::string& options) {
    try {
        cl::Program program(device.context, {device.device}, {binary});
        if (builds(program, device, options)) return program;
    } catch (const cl::Error&) {
        // A driver may refuse its own binary, e.g. after an update of its compiler alone: build
        // from source then.
    }
    return {};
}

cl::Program from_source(
    const Device& device, const std::string& source, const std::string& options) {
    cl::Program program(device.context, source);
    if (builds(program, device, options)) return program;
    if (device.info.correctly_rounded) {
        // Some drivers report correctly rounded division and then do not know the option.
        cl::Program plain(device.context, source);
        if (builds(plain, device, "-cl-std=CL1.2")) return plain;
    }
    const std::string log = build_log(program, device);
    throw Error("{} ({})\n{}", first_error(log), device.info.name, log);
}

std::vector<unsigned char> binary_of(const cl::Program& program) {
    try {
        const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
        return binaries.size() == 1 ? binaries.front() : std::vector<unsigned char>();
    } catch (const cl::Error&) {
        return {};  // a driver without binaries: nothing to keep
    }
}

}  // namespace

std::string kernel_file(const std::string& name) {
    const auto text = find_kernel_file(name);
    if (!text) throw Error("{}: there is no such kernel file", kernel_path(name));
    return *text;
}

std::string assemble_source(const std::string& defines, const std::vector<std::string>& files) {
    std::string head = "#pragma OPENCL FP_CONTRACT OFF\n" + defines;
    if (head.back() != '\n') head += '\n';
    Assembler assembler(head);
    for (const std::string& file : files) assembler.add(file, kernel_file(file));
    return assembler.source();
}

cl::Program build_program(const Device& device, const std::string& source, BuildReport* report) {
    const auto start = std::chrono::steady_clock::now();
    std::string options = "-cl-std=CL1.2";
    if (device.info.correctly_rounded) options += " -cl-fp32-correctly-rounded-divide-sqrt";
    const BinaryCache cache(device, source, options);

    cl::Program program;
    if (const auto binary = cache.load()) program = from_binary(device, *binary, options);
    const bool from_cache = program() != nullptr;
    if (!from_cache) {
        program = from_source(device, source, options);
        if (!cache.path().empty()) cache.store(binary_of(program));
    }
    if (report != nullptr) {
        report->seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        report->from_cache = from_cache;
        report->log = build_log(program, device);
    }
    return program;
}

}  // namespace wavepath

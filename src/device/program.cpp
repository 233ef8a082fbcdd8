#include "device/program.h"

#include "device/binary_cache.h"
#include "device/driver_failure.h"
#include "device/embedded_kernels.h"
#include "device/selection.h"
#include "error.h"
#include "stopwatch.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

namespace wavepath {

namespace {

std::optional<std::string> kernel_folder() {
    const char* folder = std::getenv("WAVEPATH_KERNELS");
    if (folder == nullptr || *folder == '\0') return std::nullopt;
    return folder;
}

// Where a kernel file is said to be: on disk if WAVEPATH_KERNELS is set, and in messages and #line.
std::string kernel_path(const std::string& name) {
    return kernel_folder().value_or("kernels") + "/" + name;
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
    const auto folder = kernel_folder();
    return folder ? file_in_folder(*folder, name) : embedded_file(name);
}

std::string quoted(const std::string& path) {
    std::string text = "\"";
    for (const char c : path) {
        if (c == '"' || c == '\\') text += '\\';
        text += c;
    }
    return text + '"';
}

// A preprocessor line, "# include "x.h"  // why" -> {"include", "\"x.h\"  // why"}; both empty for
// any other line.
struct Directive {
    std::string_view word, rest;
};

std::string_view without_leading_blanks(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

Directive directive_of(std::string_view line) {
    line = without_leading_blanks(line);
    if (!line.starts_with('#')) return {};
    line = without_leading_blanks(line.substr(1));
    const std::size_t word_end =
        std::min(line.find_first_not_of("abcdefghijklmnopqrstuvwxyz"), line.size());
    return {line.substr(0, word_end), without_leading_blanks(line.substr(word_end))};
}

// Shared headers tell the two languages apart by #ifdef __cplusplus; what they include for C++ is
// no kernel file.
class HostOnlyLines {
  public:
    // Whether C++ alone sees the line. To be asked for every directive of a file, in order.
    bool contain(const Directive& directive) {
        if (directive.word.starts_with("if")) {
            ++depth_;
            if (host_depth_ == 0 && directive.word == "ifdef" &&
                directive.rest.starts_with("__cplusplus"))
                host_depth_ = depth_;
        } else if (directive.word.starts_with("el") || directive.word == "endif") {
            if (depth_ == host_depth_) host_depth_ = 0;
            if (directive.word == "endif") --depth_;
        }
        return host_depth_ != 0;
    }

  private:
    int depth_ = 0;
    int host_depth_ = 0;  // depth of the #ifdef __cplusplus around the line; 0: there is none
};

// Appends files to a source, each once, with #line before and after.
class Assembler {
  public:
    explicit Assembler(std::string source) : source_(std::move(source)) {}

    void add(const std::string& name, const std::string& text) {
        if (!added_.insert(name).second) return;
        const std::string path = kernel_path(name);
        source_ += fmt::format("#line 1 {}\n", quoted(path));
        std::istringstream lines(text);
        HostOnlyLines host_only;
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            const Directive directive = directive_of(line);
            const bool ours = !host_only.contain(directive);
            if (ours && directive.word == "include" && directive.rest.starts_with('"')) {
                include(directive.rest, path, number);
                source_ += fmt::format("#line {} {}\n", number + 1, quoted(path));
            } else if (ours && directive.word == "pragma" && directive.rest.starts_with("once")) {
                source_ += '\n';  // compilers warn of it outside a header: to them this is one file
            } else {
                source_ += line + '\n';
            }
        }
    }

    const std::string& source() const { return source_; }

  private:
    // `quoted_name` begins with the name in quotes.
    void include(std::string_view quoted_name, const std::string& includer, int line) {
        const std::string name(quoted_name.substr(1, quoted_name.find('"', 1) - 1));
        const auto text = find_kernel_file(name);
        if (!text)
            throw Error(
                "{}:{}: #include \"{}\": there is no such kernel file; paths start at the kernel "
                "folder",
                includer, line, name);
        add(name, *text);
    }

    std::string source_;
    std::set<std::string> added_;
};

// Whether `text` ends in ":line:column".
bool is_place(std::string_view text) {
    for (int numbers = 0; numbers < 2; ++numbers) {
        const std::size_t digits = text.find_last_not_of("0123456789");
        if (digits == std::string_view::npos || digits + 1 == text.size() || text[digits] != ':')
            return false;
        text = text.substr(0, digits);
    }
    return !text.empty();
}

// The first error of a log in clang's form, which most drivers share up to the order of "error:"
// and place: "kernels/a.cl:7:44: error: what", or PoCL's "error: kernels/a.cl:7:44: what".
std::string first_error(const std::string& log) {
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t found = line.find("error: ");
        if (found == std::string::npos) continue;
        std::string after = line.substr(found + 7);
        if (is_place(std::string_view(after).substr(0, after.find(": ")))) return after;
        const std::string before = line.substr(0, line.find(": "));
        if (is_place(before)) return fmt::format("{}: {}", before, after);
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
    if (is_pocl(device.info) && log.find("error: ") == std::string::npos)
        throw Error("the kernels do not build ({}): {}", device.info.name, pocl_cache_advice());
    throw Error(
        "{} ({}); mend the folder that WAVEPATH_KERNELS names or unset it, else report it\n{}",
        first_error(log), device.info.name, log);
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
    if (!text)
        throw Error(
            "{}: there is no such kernel file; name a folder with all of them, or unset "
            "WAVEPATH_KERNELS",
            kernel_path(name));
    return *text;
}

std::string assemble_source(const std::string& defines, const std::vector<std::string>& files) {
    std::string head = "#pragma OPENCL FP_CONTRACT OFF\n" + defines;
    if (head.back() != '\n') head += '\n';
    Assembler assembler(head);
    for (const std::string& file : files) assembler.add(file, kernel_file(file));
    return assembler.source();
}

void describe_build(const Device& device, const cl::Program& program, BuildReport& report) {
    if (!is_pocl(device.info)) report.binary_bytes = binary_of(program).size();
    std::vector<cl::Kernel> kernels;
    cl::Program(program).createKernels(&kernels);
    for (const cl::Kernel& kernel : kernels)
        report.kernels.push_back(
            {kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(),
             kernel.getWorkGroupInfo<CL_KERNEL_PRIVATE_MEM_SIZE>(device.device),
             kernel.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(device.device),
             kernel.getWorkGroupInfo<CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE>(device.device)});
    std::ranges::sort(report.kernels, {}, &KernelBuild::name);
}

cl::Program build_program(const Device& device, const std::string& source, BuildReport* report) {
    Stopwatch watch;
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
    if (is_pocl(device.info) && program.getInfo<CL_PROGRAM_NUM_KERNELS>() == 0)
        throw Error(
            "the program built holds no kernel ({}): {}", device.info.name, pocl_cache_advice());
    if (report != nullptr) {
        report->seconds = watch.lap();
        report->from_cache = from_cache;
        report->log = build_log(program, device);
    }
    return program;
}

}  // namespace wavepath

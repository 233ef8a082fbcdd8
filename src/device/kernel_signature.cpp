#include "device/kernel_signature.h"

#include "error.h"

#include <algorithm>
#include <sstream>

namespace wavepath {

namespace {

// What a macro without parameters stands for, its lines joined; nothing where there is none.
std::string expansion(const std::string& source, const std::string& macro) {
    const std::string head = "#define " + macro + " ";
    const std::size_t start = source.find(head);
    if (start == std::string::npos) return {};
    std::string text;
    for (std::size_t i = start + head.size(); i < source.size() && source[i] != '\n'; ++i) {
        const bool joins = source[i] == '\\' && source[i + 1] == '\n';
        text += joins ? ' ' : source[i];
        if (joins) ++i;
    }
    return text;
}

std::vector<std::string> words(std::string text) {
    std::ranges::replace(text, '*', ' ');
    std::istringstream stream(text);
    std::vector<std::string> list;
    for (std::string word; stream >> word;) list.push_back(word);
    return list;
}

KernelParameter parameter(const std::string& text, const std::string& kernel) {
    KernelParameter read;
    read.declaration = text;
    read.is_buffer = text.find('*') != std::string::npos;
    std::vector<std::string> left = words(text);
    const bool is_const = std::erase(left, "const") > 0;
    std::erase_if(left, [](const std::string& word) {
        return word == "constant" || word == "global" || word == "restrict";
    });
    if (left.size() != 2) throw Error("kernel {}: no parameter: {}", kernel, text);
    if (!read.is_buffer && left[0] != "uint")
        throw Error("kernel {}: numbers are uint, and this is none: {}", kernel, text);
    read.type = left[0];
    read.name = left[1];
    read.is_written = read.is_buffer && !is_const;
    return read;
}

void append(
    std::vector<KernelParameter>& list,
    const std::string& source,
    const std::string& kernel,
    const std::string& parameters) {
    std::istringstream stream(parameters);
    for (std::string text; std::getline(stream, text, ',');) {
        const std::vector<std::string> found = words(text);
        const std::string macro = found.size() == 1 ? expansion(source, found[0]) : "";
        if (macro.empty())
            list.push_back(parameter(text, kernel));
        else
            append(list, source, kernel, macro);
    }
}

}  // namespace

std::vector<KernelParameter> kernel_signature(
    const std::string& source, const std::string& kernel) {
    const std::string head = "kernel void " + kernel + "(";
    const std::size_t start = source.find(head);
    if (start == std::string::npos) throw Error("kernel {}: not in the program", kernel);
    const std::size_t from = start + head.size();
    std::vector<KernelParameter> list;
    append(list, source, kernel, source.substr(from, source.find(')', from) - from));
    return list;
}

}  // namespace wavepath

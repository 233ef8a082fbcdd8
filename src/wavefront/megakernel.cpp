#include "wavefront/megakernel.h"

#include "device/kernel_signature.h"
#include "wavefront/chain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace wavepath {

namespace {

// A buffer that one of the stages writes is one that this kernel writes.
void join(std::vector<KernelParameter>& all, const std::vector<KernelParameter>& more) {
    for (const KernelParameter& parameter : more) {
        const auto found = std::ranges::find(all, parameter.name, &KernelParameter::name);
        if (found == all.end())
            all.push_back(parameter);
        else if (parameter.is_written)
            *found = parameter;
    }
}

template <typename Member>
std::string listed(const std::vector<KernelParameter>& parameters, Member member) {
    std::vector<std::string> texts;
    for (const KernelParameter& parameter : parameters) texts.push_back(parameter.*member);
    return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

std::string megakernel_text(const Features& features, const std::string& source) {
    std::vector<KernelParameter> parameters;
    std::string stages;
    const auto call = [&](const std::string& stage, Shape = Shape::slots) {
        if (stage == "scan_queue") return;  // counts for the host, which asks for nothing
        const std::vector<KernelParameter> own = kernel_signature(source, stage);
        join(parameters, own);
        stages += fmt::format("        {}({});\n", stage, listed(own, &KernelParameter::name));
        if (stage == "generate_rays")
            stages += "        if (hit_of(hits, settings->stride, slot) == HIT_IDLE) return;\n";
    };
    iterate(features, call, [] {});
    return fmt::format(
        "#line 1 \"megakernel\"\n"
        "kernel void megakernel({}) {{\n"
        "    const size_t slot = get_global_id(0);\n"
        "    while (slot < slots) {{\n{}    }}\n}}\n",
        listed(parameters, &KernelParameter::declaration), stages);
}

}  // namespace wavepath

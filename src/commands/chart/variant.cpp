#include "commands/chart/variant.h"

#include "error.h"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace wavepath {

namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& text) {
    std::istringstream stream(text);
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

bool is_method(const std::string& word) {
    return std::ranges::find(methods(), word, &Method::name) != methods().end();
}

// A comma separates variants where a method follows, since values have commas too: --splits 1,1,4.
std::vector<Words> split_variants(const std::string& list) {
    std::vector<Words> variants;
    std::istringstream stream(list);
    for (std::string part; std::getline(stream, part, ',');) {
        const Words words = words_of(part);
        if (!words.empty() && (variants.empty() || is_method(words.front())))
            variants.push_back(words);
        else if (!words.empty()) {
            Words& last = variants.back();
            last.back() += "," + words.front();
            last.insert(last.end(), words.begin() + 1, words.end());
        }
    }
    return variants;
}

RenderOptions options_of(const Words& words, RenderOptions options, const std::string& label) {
    CLI::App app;
    add_variant_options(app, options);
    std::vector<std::string> arguments(words.rbegin(), words.rend());  // as CLI11 takes them
    arguments.emplace_back("--method");
    try {
        app.parse(arguments);
    } catch (const CLI::ParseError& error) {
        throw Error(
            "--methods, \"{}\": {}; behind a method stand options of how to compute, such as "
            "--sampler independent",
            label, error.what());
    }
    return options;
}

}  // namespace

std::vector<Variant> parse_variants(
    const std::string& list, const RenderOptions& options, const RenderJob& job) {
    std::vector<Variant> variants;
    for (const Words& words : split_variants(list)) {
        Variant variant;
        variant.label = fmt::format("{}", fmt::join(words, " "));
        if (std::ranges::count(variants, variant.label, &Variant::label) > 0)
            throw Error("--methods: \"{}\" stands there twice; take one away", variant.label);
        const RenderOptions own = options_of(words, options, variant.label);
        variant.device = own.device;
        try {
            variant.settings = parse_settings(own);
        } catch (const Error& error) {
            throw Error("--methods, \"{}\": {}", variant.label, error.what());
        }
        variant.settings.camera = job.settings.camera;
        variant.settings.width = job.settings.width;
        variant.settings.height = job.settings.height;
        variants.push_back(std::move(variant));
    }
    if (variants.empty()) throw Error("--methods \"{}\": name a method, such as mis", list);
    return variants;
}

}  // namespace wavepath

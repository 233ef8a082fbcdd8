#include "commands/trace.h"

namespace wavepath {

using nlohmann::ordered_json;

namespace {

constexpr int process = 1;
constexpr int host_row = 0;  // kernels follow, in the order of the profile

double microseconds(int64_t nanoseconds) {
    return 1e-3 * static_cast<double>(nanoseconds);
}

ordered_json name_of(const char* what, int row, const std::string& name) {
    return {
        {"name", what}, {"ph", "M"}, {"pid", process}, {"tid", row}, {"args", {{"name", name}}}};
}

ordered_json complete_event(const std::string& name, int row, int64_t start, int64_t end) {
    return {
        {"name", name},
        {"ph", "X"},
        {"pid", process},
        {"tid", row},
        {"ts", microseconds(start)},
        {"dur", microseconds(end - start)}};
}

ordered_json counter(const char* name, int64_t time, uint64_t value) {
    return {
        {"name", name},
        {"ph", "C"},
        {"pid", process},
        {"ts", microseconds(time)},
        {"args", {{name, value}}}};
}

}  // namespace

ordered_json trace_of(const std::string& scene, const RenderResult& result) {
    const auto row_of = [](std::size_t kernel) { return host_row + 1 + static_cast<int>(kernel); };
    ordered_json events = ordered_json::array();
    events.push_back(name_of("process_name", host_row, "wavepath " + scene));
    events.push_back(name_of("thread_name", host_row, "host"));
    for (std::size_t k = 0; k < result.profile.size(); ++k)
        events.push_back(name_of("thread_name", row_of(k), result.profile[k].name));
    for (const Timeline::Span& span : result.timeline->spans())
        events.push_back(complete_event(span.name, host_row, span.start, span.end));
    for (const Timeline::Launch& launch : result.timeline->launches()) {
        ordered_json event = complete_event(
            result.profile[launch.row].name, row_of(launch.row), launch.start, launch.end);
        event["args"] = {{"items", launch.items}};
        events.push_back(std::move(event));
    }
    for (const Timeline::Count& count : result.timeline->counts()) {
        events.push_back(counter("slots with work", count.time, count.slots));
        events.push_back(counter("rays in flight", count.time, count.rays));
    }
    return {{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}};
}

}  // namespace wavepath

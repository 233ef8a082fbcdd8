#include "page/chart.h"

#include "error.h"

#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

namespace wavepath {

namespace {

// [Okabe and Ito 2008] without black and yellow, which one of the two backgrounds hides, and grey.
constexpr std::array palette{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                             "#E69F00", "#56B4E9", "#888888"};
constexpr std::array point_types{7, 5, 9, 13, 11, 6, 4};

// A folder that is removed with what it holds.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "wavepath-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw Error("{}: no folder can be made there; set TMPDIR", name);
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'') result += '\'';
        result += c == '\n' ? ' ' : c;
    }
    return result + "'";
}

bool is_drawn(const Chart& chart, double x, double y) {
    return std::isfinite(x) && std::isfinite(y) && (!chart.log_x || x > 0) &&
           (!chart.log_y || y > 0);
}

// Its rows x, y, low, high as a data block, and whether there is any.
bool append_data(const Chart& chart, const Curve& curve, std::size_t index, std::string& script) {
    std::string rows;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
        const double y = curve.y[i];
        if (!is_drawn(chart, curve.x[i], y)) continue;
        double low = curve.low.empty() ? y : curve.low[i];
        const double high = curve.high.empty() ? y : curve.high[i];
        if (chart.log_y) low = std::max(low, 1e-3 * y);
        rows += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}\n", curve.x[i], y, low, high);
    }
    script += fmt::format("$curve{} << EOD\n{}EOD\n", index, rows);
    return !rows.empty();
}

std::string style_of(const Curve& curve) {
    const auto index = static_cast<std::size_t>(curve.color);
    const std::string color = fmt::format(" lc rgb '{}'", palette[index % palette.size()]);
    const int point = point_types[index % point_types.size()];
    switch (curve.mark) {
        case Mark::line:
            return "lines lw 2" + color;
        case Mark::dashed_line:
            return "lines lw 1.5 dt 2" + color;
        case Mark::points:
            return fmt::format("points ps .8 pt {}{}", point, color);
        case Mark::points_on_line:
            return fmt::format("linespoints lw 2 ps .8 pt {}{}", point, color);
        case Mark::bars:
            return "boxes fs solid .85 noborder" + color;
    }
    return {};
}

std::string script_of(const Chart& chart, const std::filesystem::path& output) {
    std::string script = fmt::format(
        "set encoding utf8\nset terminal svg size 880,{} dynamic font 'sans-serif,15'\n"
        "set output {}\nset border 3\nset tics nomirror\nset grid lc rgb '#888888' lw .3 lt 1\n"
        "set key outside right top Left reverse noenhanced samplen 2 spacing 1.2\n"
        "set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n",
        chart.bars.empty() ? 480 : 560, quoted(output.string()), quoted(chart.title),
        quoted(chart.x_label), quoted(chart.y_label));
    if (chart.log_x) script += "set logscale x\nset format x '10^{%L}'\n";
    if (chart.log_y) script += "set logscale y\nset format y '10^{%L}'\n";
    if (!chart.bars.empty()) {
        script += "set boxwidth .7\nset yrange [0:*]\nset xtics rotate by -40 noenhanced (";
        for (std::size_t i = 0; i < chart.bars.size(); ++i)
            script += fmt::format("{}{} {}", i > 0 ? "," : "", quoted(chart.bars[i]), i);
        script += ")\n";
    }
    std::string plots;
    for (std::size_t i = 0; i < chart.curves.size(); ++i) {
        const Curve& curve = chart.curves[i];
        if (!append_data(chart, curve, i, script)) continue;
        const std::string title =
            curve.name.empty() ? "notitle" : "title " + quoted(curve.name) + " noenhanced";
        plots += fmt::format(
            "{}$curve{} using 1:2 with {} {}", plots.empty() ? "plot " : ", ", i, style_of(curve),
            title);
        if (!curve.low.empty())
            plots += fmt::format(
                ", $curve{} using 1:3:(0):($4-$3) with vectors nohead lw 2 lc rgb '{}' notitle", i,
                palette[static_cast<std::size_t>(curve.color) % palette.size()]);
    }
    // gnuplot refuses to draw nothing.
    return script + (plots.empty() ? "set key off\nplot [0:1] [0:1] NaN" : plots) + "\n";
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

bool gnuplot_runs(std::string script) {
    std::string name = "gnuplot";
    char* const argv[] = {name.data(), script.data(), nullptr};
    pid_t child = 0;
    if (posix_spawnp(&child, name.c_str(), nullptr, nullptr, argv, environ) != 0) return false;
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

void check_gnuplot() {
    if (!gnuplot_runs("/dev/null"))
        throw Error("gnuplot draws the charts and cannot be run: install the package gnuplot-nox");
}

std::string draw_svg(const Chart& chart) {
    const TemporaryFolder folder;
    const std::filesystem::path output = folder.path() / "chart.svg";
    const std::filesystem::path script = folder.path() / "chart.gnuplot";
    std::ofstream(script, std::ios::binary) << script_of(chart, output);
    if (!gnuplot_runs(script.string())) {
        check_gnuplot();
        throw Error("gnuplot cannot draw \"{}\"; what it says stands above", chart.title);
    }
    std::ifstream file(output, std::ios::binary);
    std::string svg(std::istreambuf_iterator<char>(file), {});
    svg.erase(0, std::min(svg.find("<svg"), svg.size()));
    if (svg.empty()) throw Error("gnuplot drew nothing of \"{}\"; report it", chart.title);
    for (const std::string_view black : {"'black'", "\"black\""})
        replace_all(svg, black, "\"currentColor\"");
    replace_all(svg, "color=\"currentColor\"", "");
    return svg;
}

}  // namespace wavepath

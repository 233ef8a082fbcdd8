// Charts, drawn by gnuplot.
#pragma once

#include <string>
#include <vector>

namespace wavepath {

enum class Mark { line, dashed_line, points, points_on_line, bars };

struct Curve {
    std::string name;  // in the legend; empty: in none
    std::vector<double> x{}, y{};
    std::vector<double> low{}, high{};  // of y, at every x; empty: no intervals
    Mark mark = Mark::points_on_line;
    int color = 0;  // 0, 1, ...: of the palette; curves of one color belong together
};

struct Chart {
    std::string title, x_label, y_label;
    bool log_x = false, log_y = false;
    std::vector<Curve> curves;
    // Of Mark::bars: what stands at x = 0, 1, ...
    std::vector<std::string> bars;
};

// An <svg> element whose text and axes follow `color` of the page around it, in the palette of
// [Okabe and Ito 2008]. Points whose numbers are not finite, or not above 0 on a logarithmic axis,
// are left out. Throws Error where gnuplot is missing or fails.
std::string draw_svg(const Chart& chart);

// Throws Error where draw_svg would, for lack of gnuplot: to be asked before hours of rendering.
void check_gnuplot();

}  // namespace wavepath

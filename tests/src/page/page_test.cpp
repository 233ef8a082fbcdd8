// Charts and pages that open from disk.
#include "page/page.h"

#include "error.h"
#include "support/environment_variable.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>

namespace wavepath {
namespace {

using testing::HasSubstr;
using testing::Not;

bool has_gnuplot() {
    try {
        check_gnuplot();
        return true;
    } catch (const Error&) {
        return false;
    }
}

Chart chart_of(std::vector<double> x, std::vector<double> y) {
    Chart chart;
    chart.title = "it's <small> & 5 % \"here\"";
    chart.curves.push_back({.name = "a_b ^2", .x = std::move(x), .y = std::move(y)});
    return chart;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
        ++n;
    return n;
}

TEST(Chart, DrawsEveryPointThatCanBeDrawn) {
    if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
    Chart chart = chart_of({1, 2, 3, 4}, {1, 2, -3, NAN});
    chart.curves[0].mark = Mark::points;
    const std::string linear = draw_svg(chart);
    chart.log_y = true;
    const std::string logarithmic = draw_svg(chart);
    EXPECT_EQ(linear.substr(0, 4), "<svg");
    EXPECT_THAT(linear, HasSubstr("a_b ^2"));
    EXPECT_THAT(linear, Not(HasSubstr("black")));
    // One more stands in the legend.
    EXPECT_EQ(count(linear, "<use xlink:href='#gpPt6'"), 3U + 1);
    EXPECT_EQ(count(logarithmic, "<use xlink:href='#gpPt6'"), 2U + 1);
}

TEST(Chart, OfNothingIsDrawnToo) {
    if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
    EXPECT_EQ(draw_svg(chart_of({}, {})).substr(0, 4), "<svg");
    EXPECT_EQ(draw_svg({}).substr(0, 4), "<svg");
}

TEST(Chart, SaysWhatIsMissing) {
    const EnvironmentVariable path("PATH", "/nowhere");
    try {
        draw_svg(chart_of({1}, {1}));
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("install the package gnuplot-nox"));
    }
}

TEST(Page, EscapesWhatItIsGiven) {
    const TemporaryFolder folder;
    Page page("a < b & c");
    page.heading("<h>");
    page.paragraph("x > \"y\"");
    page.command("wavepath render 'a&b.gltf'");
    page.table({{"name", "value"}, {{"<n>", "1.5"}, {"m", "-2"}}});
    page.pictures({{"<mis>", "mis.png", "wavepath render"}});
    page.write(folder / "page.html");
    const std::string html = folder.read("page.html");
    EXPECT_THAT(html, HasSubstr("<title>a &lt; b &amp; c</title>"));
    EXPECT_THAT(html, HasSubstr("<h2>&lt;h&gt;</h2>"));
    EXPECT_THAT(html, HasSubstr("<p>x &gt; &quot;y&quot;</p>"));
    EXPECT_THAT(html, HasSubstr("<td>&lt;n&gt;</td><td class=\"number\">1.5</td>"));
    EXPECT_THAT(html, HasSubstr("<img src=\"mis.png\" alt=\"&lt;mis&gt;\">"));
    EXPECT_THAT(html, Not(HasSubstr("http")));  // no network
}

TEST(Page, ChartsOfOnePageHaveNamesOfTheirOwn) {
    if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
    const TemporaryFolder folder;
    Page page("two");
    page.chart(chart_of({1, 2}, {1, 2}));
    page.chart(chart_of({1, 2}, {1, 2}));
    page.write(folder / "page.html");
    const std::string html = folder.read("page.html");
    static const std::regex pattern("id=['\"]([^'\"]*)['\"]");
    std::multiset<std::string> names;
    for (std::sregex_iterator i(html.begin(), html.end(), pattern), end; i != end; ++i)
        names.insert((*i)[1]);
    EXPECT_GT(names.size(), 20U);
    for (const std::string& name : names) EXPECT_EQ(names.count(name), 1U) << name;
}

TEST(Page, ThatCannotBeWrittenIsAnError) {
    EXPECT_THROW(Page("a").write("/nowhere/page.html"), Error);
}

}  // namespace
}  // namespace wavepath

// A page that opens from disk: HTML without network, readable without JavaScript, dark and light.
#pragma once

#include "page/chart.h"

#include <filesystem>
#include <string>
#include <vector>

namespace wavepath {

struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;  // numbers stand to the right, text to the left
};

// One of several pictures of one size, which zoom and pan together.
struct Picture {
    std::string title;
    std::filesystem::path file;  // beside the page
    std::string command;         // that made it; empty: none
};

class Page {
  public:
    explicit Page(const std::string& title);

    // Texts are plain; what HTML would read as its own is escaped.
    void heading(const std::string& text);
    void paragraph(const std::string& text);
    void command(const std::string& line);  // of a shell
    void table(const Table& table);
    void chart(const Chart& chart);  // throws Error as draw_svg does
    void pictures(const std::vector<Picture>& pictures);

    // Writes the page, whole or not at all. Throws Error where that fails.
    void write(const std::filesystem::path& path) const;

  private:
    std::string title_;
    std::string body_;
};

}  // namespace wavepath

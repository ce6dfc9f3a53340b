// The pieces of our HTML reports: one file each, pictures inside, light and dark, no script from elsewhere.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/image.h"

namespace halfspace::compare {

// & < > " as entities.
std::string escape_html(std::string_view text);

std::string base64(std::span<const uint8_t> bytes);

// src of an <img>: the picture as PNG in a data URI.
std::string data_uri(const Image& image);

struct Figure {
  std::string source;   // src of the <img>
  std::string caption;  // plain text
  bool pixelated = false;
};

// Figures side by side; as many in a row as fit.
std::string figures_html(const std::vector<Figure>& figures);

// Cells are HTML already; numbers are set flush right. The first row of cells is the heading.
struct Table {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;
};
std::string table_html(const Table& table);

// "pass" or "fail" as a coloured mark with its word: colour alone tells nothing to some.
std::string mark_html(bool good);

// A complete document.
std::string page_html(const std::string& title, const std::string& body);

// Makes missing folders; writes through a temporary file, so that a full disk leaves no half report.
// Throws ImageError (it is the pictures' report) when it cannot.
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace halfspace::compare

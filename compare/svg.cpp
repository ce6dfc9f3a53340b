#include "compare/svg.h"

#include <cstdio>

#include "compare/html.h"

namespace halfspace::compare {
namespace {

constexpr double kLetterWidth = 0.53;  // of the size, on average

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::string attribute(const char* name, double value) {
  return std::string(" ") + name + "=\"" + number(value) + "\"";
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

}  // namespace

Svg::Svg(double width, double height)
    : text_("<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width) +
            attribute("height", height) + " viewBox=\"0 0 " + number(width) + " " + number(height) +
            "\" font-family=\"system-ui, sans-serif\">\n") {
  rect(0, 0, width, height, "#fbfbfa");
}

void Svg::text(double x, double y, const std::string& words, const TextStyle& style) {
  text_ += "<text" + attribute("x", x) + attribute("y", y) + attribute("text-anchor", style.anchor) +
           attribute("fill", style.color) + attribute("font-size", std::to_string(style.size)) +
           (style.bold ? attribute("font-weight", "600") : "") +
           // A rim of the ground's colour keeps words legible across lines.
           " paint-order=\"stroke\" stroke=\"#fbfbfa\" stroke-width=\"3\">" + escape_html(words) +
           "</text>\n";
}

void Svg::line(double x0, double y0, double x1, double y1, const char* color, double width,
               const char* dashes) {
  text_ += "<line" + attribute("x1", x0) + attribute("y1", y0) + attribute("x2", x1) + attribute("y2", y1) +
           attribute("stroke", color) + attribute("stroke-width", width) +
           (*dashes ? attribute("stroke-dasharray", dashes) : "") + "/>\n";
}

void Svg::circle(double x, double y, double radius, const char* fill, const char* stroke) {
  text_ += "<circle" + attribute("cx", x) + attribute("cy", y) + attribute("r", radius) +
           attribute("fill", fill) + attribute("stroke", stroke) + "/>\n";
}

void Svg::rect(double x, double y, double width, double height, const std::string& fill,
               const std::string& title) {
  text_ += "<rect" + attribute("x", x) + attribute("y", y) + attribute("width", width) +
           attribute("height", height) + attribute("fill", fill) +
           (title.empty() ? "/>\n" : "><title>" + escape_html(title) + "</title></rect>\n");
}

double text_width(const std::string& words, int size) {
  return kLetterWidth * size * static_cast<double>(words.size());
}

}  // namespace halfspace::compare

// Small pieces of an SVG picture, on a light ground so that it can be read wherever it is shown.
#pragma once

#include <string>

namespace halfspace::compare {

namespace ink {
inline constexpr const char* kText = "#1d1f21";
inline constexpr const char* kSoft = "#61666c";
inline constexpr const char* kGrid = "#dfe1e4";
inline constexpr const char* kOurs = "#2f6fde";
inline constexpr const char* kOursPale = "#a8c3ef";
inline constexpr const char* kTheirs = "#b9772c";
inline constexpr const char* kFront = "#1a7f37";
}  // namespace ink

class Svg {
 public:
  Svg(double width, double height);

  struct TextStyle {
    const char* anchor = "start";  // "middle", "end"
    const char* color = ink::kText;
    int size = 12;
    bool bold = false;
  };
  void text(double x, double y, const std::string& words, const TextStyle& style);
  void text(double x, double y, const std::string& words) { text(x, y, words, {}); }
  void line(double x0, double y0, double x1, double y1, const char* color, double width = 1,
            const char* dashes = "");
  void circle(double x, double y, double radius, const char* fill, const char* stroke = "none");
  void rect(double x, double y, double width, double height, const std::string& fill,
            const std::string& title = "");

  // The whole document.
  std::string str() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

// About how wide `words` are at that size, in the units of the picture.
double text_width(const std::string& words, int size = 12);

}  // namespace halfspace::compare

#include "compare/html.h"

#include <fstream>

namespace halfspace::compare {
namespace {

// Colours come from two sets of variables, so that a reader's dark mode is kept.
constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --back: #fbfbfa; --text: #1d1f21; --soft: #61666c; --line: #d9dbde; --card: #fff;
  --good: #1a7f37; --bad: #c4232b; --ours: #2f6fde; --theirs: #b9772c; }
@media (prefers-color-scheme: dark) { :root { --back: #15171a; --text: #e4e6e8; --soft: #9aa1a8; --line: #33373c;
  --card: #1d2024; --good: #4ac26b; --bad: #ff7b72; --ours: #6ea3ff; --theirs: #e0a35c; } }
body { margin: 2rem auto; max-width: 76rem; padding: 0 1rem; background: var(--back); color: var(--text);
  font: 15px/1.5 system-ui, sans-serif; }
h1 { font-size: 1.6rem; margin: 0 0 .3rem; } h2 { font-size: 1.15rem; margin: 2.2rem 0 .5rem; }
p.note, figcaption, footer { color: var(--soft); } footer { margin-top: 3rem; font-size: .85rem; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(15rem, 1fr)); gap: 1rem; margin: .8rem 0; }
figure { margin: 0; background: var(--card); border: 1px solid var(--line); border-radius: 6px; padding: .5rem; }
figure img { width: 100%; display: block; border-radius: 3px; background: #808080; }
img.pixelated { image-rendering: pixelated; } figcaption { font-size: .85rem; padding-top: .4rem; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: .6rem 0; }
th, td { padding: .3rem .8rem; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; }
th { color: var(--soft); font-weight: 600; } th:first-child, td:first-child { text-align: left; padding-left: 0; }
.good { color: var(--good); font-weight: 600; } .bad { color: var(--bad); font-weight: 600; }
figure img { cursor: zoom-in; } figure img.large { position: fixed; inset: 0; z-index: 1; width: 100vw; height: 100vh;
  object-fit: contain; border-radius: 0; background: #000; cursor: zoom-out; }
a { color: var(--ours); } code { font-size: .92em; } svg text { fill: currentColor; }
)css";

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void append_base64_group(std::string& out, std::span<const uint8_t> group) {
  uint32_t bits = 0;
  for (size_t i = 0; i < 3; ++i) bits = bits << 8 | (i < group.size() ? group[i] : 0u);
  for (size_t i = 0; i < 4; ++i) out += i <= group.size() ? kDigits[(bits >> (18 - 6 * i)) & 63] : '=';
}

std::string row_html(const std::vector<std::string>& cells, const char* tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += std::string("<") + tag + ">" + cell + "</" + tag + ">";
  return html + "</tr>\n";
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(std::span<const uint8_t> bytes) {
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3)
    append_base64_group(out, bytes.subspan(i, std::min<size_t>(3, bytes.size() - i)));
  return out;
}

std::string data_uri(const Image& image) { return "data:image/png;base64," + base64(encode_png(image)); }

std::string figures_html(const std::vector<Figure>& figures) {
  std::string html = "<div class=\"figures\">\n";
  for (const Figure& figure : figures) {
    const std::string caption = escape_html(figure.caption);
    html += "<figure><img onclick=\"this.classList.toggle('large')\"" +
            std::string(figure.pixelated ? " class=\"pixelated\"" : "") + " alt=\"" + caption + "\" src=\"" +
            figure.source + "\"><figcaption>" + caption + "</figcaption></figure>\n";
  }
  return html + "</div>\n";
}

std::string table_html(const Table& table) {
  std::string html =
      "<div class=\"scroll\"><table>\n<thead>" + row_html(table.heading, "th") + "</thead>\n<tbody>\n";
  for (const auto& row : table.rows) html += row_html(row, "td");
  return html + "</tbody></table></div>\n";
}

std::string mark_html(bool good) {
  return good ? "<span class=\"good\">&#10003; pass</span>" : "<span class=\"bad\">&#10007; fail</span>";
}

std::string page_html(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escape_html(title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<h1>" +
         escape_html(title) + "</h1>\n" + body + "</body>\n</html>\n";
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::error_code error;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), error);
  const std::filesystem::path temporary = path.string() + ".part";
  {
    std::ofstream file(temporary, std::ios::binary);
    file << text;
    file.close();
    if (!file) {
      std::filesystem::remove(temporary, error);
      throw ImageError(path.string() + ": cannot be written; does the folder exist, and may we write there?");
    }
  }
  std::filesystem::rename(temporary, path, error);
  if (error) throw ImageError(path.string() + ": cannot be written: " + error.message());
}

}  // namespace halfspace::compare

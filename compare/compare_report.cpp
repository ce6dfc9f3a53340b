#include "compare/compare_report.h"

#include "compare/difference_text.h"

namespace halfspace::compare {
namespace {

std::string count_cell(uint64_t count) { return std::to_string(count); }

std::vector<std::string> summary_row(const ComparedPair& pair) {
  if (!pair.problem.empty())
    return {escape_html(pair.paths.name), mark_html(false), "", "", "", "", "", "", "",
            escape_html(pair.problem)};
  const Difference& d = pair.difference;
  std::string broken;
  for (const std::string& text : pair.broken) broken += (broken.empty() ? "" : "; ") + escape_html(text);
  return {escape_html(pair.paths.name),
          mark_html(pair.broken.empty()),
          count_cell(d.differing),
          short_number(d.differing_percent()) + " %",
          short_number(d.max),
          short_number(d.max_interior),
          count_cell(d.above_1),
          count_cell(d.above_8),
          d.differing == 0 ? "equal" : short_number(d.psnr()) + " dB",
          broken};
}

Table summary_table(const std::vector<ComparedPair>& pairs) {
  Table table{{"picture", "", "pixels", "share", "max", "max inside", "&gt; 1", "&gt; 8", "PSNR", ""}, {}};
  for (const ComparedPair& pair : pairs) table.rows.push_back(summary_row(pair));
  return table;
}

Table channel_table(const Difference& d) {
  constexpr const char* kNames[] = {"red", "green", "blue", "alpha"};
  Table table{{"channel", "max", "mean"}, {}};
  for (size_t c = 0; c < static_cast<size_t>(d.channel_count()); ++c)
    table.rows.push_back({kNames[c], short_number(d.channels[c].max), short_number(d.channels[c].mean)});
  return table;
}

std::string pair_section(const ComparedPair& pair, double gain) {
  std::string html = "<h2>" + escape_html(pair.paths.name) + "</h2>\n";
  if (!pair.problem.empty()) return html + "<p class=\"bad\">" + escape_html(pair.problem) + "</p>\n";
  const Difference& d = pair.difference;
  html += "<p>" + escape_html(describe_in_a_line(d)) + ". On edges " +
          count_of(d.differing_edge, d.edge_pixels) + ", inside " +
          count_of(d.differing_interior, d.pixels - d.edge_pixels) + ".</p>\n";
  const Image a = load_image(pair.paths.a), b = load_image(pair.paths.b);
  html += figures_html(difference_figures(a, b, d, gain, pair.paths.a.string(), pair.paths.b.string()));
  if (d.differing > 0) html += table_html(channel_table(d));
  return html;
}

}  // namespace

std::vector<Figure> difference_figures(const Image& a, const Image& b, const Difference& difference,
                                       double gain, const std::string& a_name, const std::string& b_name) {
  std::vector<Figure> figures{{data_uri(a), a_name}, {data_uri(b), b_name}};
  if (difference.differing == 0) return figures;
  figures.push_back({data_uri(amplified_difference(a, b, gain)), "difference x " + short_number(gain)});
  const WorstPixel& worst = difference.worst_interior ? *difference.worst_interior : *difference.worst;
  const std::string where = " around (" + std::to_string(worst.x) + ", " + std::to_string(worst.y) + ")";
  figures.push_back({data_uri(crop_around(a, worst.x, worst.y, kCropSize)), a_name + where, true});
  figures.push_back({data_uri(crop_around(b, worst.x, worst.y, kCropSize)), b_name + where, true});
  return figures;
}

std::string compare_report(const std::vector<ComparedPair>& pairs, double gain) {
  std::string body =
      "<p class=\"note\">Differences are in levels of 255. An edge pixel is one that jumps against a "
      "neighbour in the first picture; all others are inside.</p>\n";
  body += table_html(summary_table(pairs));
  for (const ComparedPair& pair : pairs) body += pair_section(pair, gain);
  return page_html("Picture comparison", body);
}

}  // namespace halfspace::compare

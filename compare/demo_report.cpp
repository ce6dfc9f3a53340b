// out/demo/report.html
#include <cstdio>

#include "compare/demo.h"
#include "compare/difference_text.h"
#include "compare/html.h"

namespace halfspace::compare {
namespace {

std::string milliseconds(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2f ms", value);
  return text;
}

std::string title_of(const DemoScene& scene) {
  return std::to_string(scene.ours.scene) + (scene.ours.name.empty() ? "" : " " + scene.ours.name);
}

std::string in_words(const Difference& d) {
  return d.differing == 0
             ? "equal"
             : short_number(d.differing_percent()) + " %, inside " + short_number(d.max_interior);
}

Table overview(const Demo& demo) {
  Table table{{"scene", "ours", "OSMesa", "ours / OSMesa", "standard to float filter", "",
               "draft to 8-bit filter", ""},
              {}};
  for (const DemoScene& scene : demo.scenes)
    table.rows.push_back({"<a href=\"#scene" + std::to_string(scene.ours.scene) + "\">" +
                              escape_html(title_of(scene)) + "</a>",
                          milliseconds(scene.ours.median_ms), milliseconds(scene.osmesa.median_ms),
                          short_number(scene.ours.median_ms / scene.osmesa.median_ms),
                          in_words(scene.standard), mark_html(keeps_promise(scene.standard)),
                          in_words(scene.draft), mark_html(keeps_promise(scene.draft))});
  return table;
}

Table versions(const Demo& demo) {
  Table table{{"", "GL_RENDERER", "GL_VERSION", "start to first picture", "peak memory"}, {}};
  for (const auto& [name, result] : {std::pair{"Halfspace", &demo.ours},
                                     {"Halfspace, draft", &demo.ours_draft},
                                     {"OSMesa", &demo.osmesa},
                                     {"OSMesa, float filter", &demo.osmesa_float}})
    table.rows.push_back({name, escape_html(result->renderer), escape_html(result->version),
                          milliseconds(result->first_picture_ms),
                          short_number(static_cast<double>(result->peak_kib) / 1024) + " MB"});
  return table;
}

Table differences(const DemoScene& scene) {
  Table table{{"", "differing", "other triangle", "inside", "max", "max inside", "&gt; 1", "&gt; 2", "&gt; 8",
               "PSNR"},
              {}};
  for (const auto& [name, d] : {std::pair{"standard to OSMesa's float filter", &scene.standard},
                                {"draft to OSMesa's 8-bit filter", &scene.draft}})
    table.rows.push_back({name, short_number(d->differing_percent()) + " %",
                          std::to_string(d->differing_edge), std::to_string(d->differing_interior),
                          short_number(d->max), short_number(d->max_interior), std::to_string(d->above_1),
                          std::to_string(d->above_2), std::to_string(d->above_8),
                          d->differing == 0 ? "equal" : short_number(d->psnr()) + " dB"});
  return table;
}

std::string scene_section(const DemoScene& scene, double gain) {
  const Image ours = load_image(scene.ours.picture);
  const Image draft = load_image(scene.ours_draft.picture);
  const Image osmesa = load_image(scene.osmesa.picture);
  const Image osmesa_float = load_image(scene.osmesa_float.picture);
  const std::string times = " x " + short_number(gain);
  std::string html =
      "<h2 id=\"scene" + std::to_string(scene.ours.scene) + "\">" + escape_html(title_of(scene)) + "</h2>\n";
  html += figures_html(
      {{data_uri(ours), "Halfspace, " + milliseconds(scene.ours.median_ms)},
       {data_uri(osmesa), "OSMesa, " + milliseconds(scene.osmesa.median_ms)},
       {data_uri(amplified_difference(osmesa_float, ours, gain)), "standard off the float filter" + times},
       {data_uri(amplified_difference(osmesa, draft, gain)), "draft off the 8-bit filter" + times}});
  return html + table_html(differences(scene));
}

}  // namespace

std::string demo_report(const Demo& demo, double gain) {
  std::string body =
      "<p class=\"note\">The same program, ref_app, drew each scene four times: on our libOSMesa at the "
      "standard and at "
      "the draft level, on the system's, which filters textures with 8-bit weights, and on the system's made "
      "to filter "
      "in float (GALLIVM_PERF=no_aos_sampling). Times are medians of clear + draw + finish with as many "
      "threads as each "
      "chooses; <code>halfspace bench scenes</code> measures them thread for thread. Differences are in "
      "levels of 255; <em>other triangle</em> are those at pixels where the two show another one (drawn "
      "again with every "
      "triangle in a colour of its own), and <em>inside</em> is everywhere else. A scene passes when at "
      "most " +
      short_number(kMostDifferingPercent) + " % of its pixels differ, none inside by more than " +
      short_number(kMostInteriorLevels) + " level.</p>\n";
  body += table_html(overview(demo)) + table_html(versions(demo));
  for (const DemoScene& scene : demo.scenes) body += scene_section(scene, gain);
  return page_html("Halfspace beside OSMesa", body);
}

}  // namespace halfspace::compare

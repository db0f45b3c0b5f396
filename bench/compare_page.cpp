#include "bench/compare_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bench/html.h"
#include "bench/page_files.h"
#include "app/render_report.h"
#include "io/image_file.h"
#include "render/color_space.h"

namespace quincunx {
namespace {

constexpr int kThumbnail = 192;       // pixels of the longer edge, at most
constexpr double kAmplified = 8.0;    // differences of colours

std::string_view page_file(std::string_view name) {
  for (std::size_t n = 0; n < page_files::kFileCount; ++n)
    if (page_files::kFiles[n].name == name) return {page_files::kFiles[n].text, page_files::kFiles[n].bytes};
  assert(false);
  return {};
}

/// Means of squares of pixels, so that the longer edge is kThumbnail or less.
Image smaller(const Image& image) {
  const int by = (std::max(image.width, image.height) + kThumbnail - 1) / kThumbnail;
  if (by <= 1) return image;
  Image small{image.width / by, image.height / by, image.channels, {}};
  const std::size_t channels = image.channels.size();
  for (int j = 0; j < small.height; ++j)
    for (int i = 0; i < small.width; ++i)
      for (std::size_t c = 0; c < channels; ++c) {
        double sum = 0.0;
        for (int y = 0; y < by; ++y)
          for (int x = 0; x < by; ++x) sum += double(image.pixels[(std::size_t(j * by + y) * std::size_t(image.width) + std::size_t(i * by + x)) * channels + c]);
        small.pixels.push_back(float(sum / (by * by)));
      }
  return small;
}

std::string picture(const Image& image, const std::string& what) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", html_text(what), base64(png_bytes(smaller(image))));
}

/// |a - b| of sRGB, amplified: black where they are the same.
Image difference(const Frame& a, const Frame& b) {
  Image image = to_opaque_image(a);
  const Image other = to_opaque_image(b);
  for (std::size_t p = 0; p + 2 < image.pixels.size(); p += 3) {
    const auto shown = [p](const Image& i) { return srgb_from_linear(glm::clamp(glm::dvec3(i.pixels[p], i.pixels[p + 1], i.pixels[p + 2]), 0.0, 1.0)); };
    const glm::dvec3 off = linear_from_srgb(glm::clamp(kAmplified * glm::abs(shown(image) - shown(other)), 0.0, 1.0));
    for (int c = 0; c < 3; ++c) image.pixels[p + std::size_t(c)] = float(off[c]);
  }
  return image;
}

std::string pictures(const CompareReport& report) {
  const CompareMeasurement& m = report.measured;
  std::string text = fmt::format("<h2>Pictures</h2>\n<p>The first view, and its difference from that of {}, {:g} times as bright.</p>\n<div class=\"pictures\">\n",
                                 m.truth ? "the truth" : "the reference of its spline", kAmplified);
  if (m.truth) text += fmt::format("<figure>{}<figcaption>truth</figcaption></figure>\n", picture(to_opaque_image(*m.truth), "truth"));
  for (std::size_t n = 0; n < m.lines.size(); ++n) {
    const std::string label = m.lines[n].setting.label(*report.subject);
    const Frame& expected = m.truth ? *m.truth : m.references[n];
    text += fmt::format("<figure data-row=\"{}\">{}{}<figcaption>{}</figcaption></figure>\n", n, picture(to_opaque_image(m.lines[n].picture), label),
                        picture(difference(m.lines[n].picture, expected), "difference of " + label), html_text(label));
  }
  return text + "</div>\n";
}

/// JSON inside a script element: nothing in it may end the element.
std::string script_json(const nlohmann::ordered_json& json) {
  std::string text;
  for (const char c : json.dump()) text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

/// A library as it was, without the comment that names a file beside it.
std::string without_map(std::string_view script) {
  const std::size_t comment = script.rfind("//# sourceMappingURL=");
  return std::string(script.substr(0, comment));
}

}  // namespace

std::string compare_html(const CompareReport& report) {
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>Quincunx: {}</title>\n<style>{}\n{}</style></head>\n<body>\n"
      "<h1>Error against time: {}</h1>\n<p>{}.<br>{}.</p>\n<p><code>{}</code></p>\n",
      html_text(report.subject->name), kPageStyle, page_file("compare.css"), html_text(report.subject->name), html_text(compare_caption(report)), html_text(machine_text(report.machine)),
      html_text(report.command));
  page += "<h2>Chart</h2>\n<p><label>Error: <select id=\"error\"></select></label> A colour is a spline, a shape the way to the hit; the line is the Pareto front: no other combination is both faster and "
          "less wrong. Errors of 0 stand on the lower edge.</p>\n<div class=\"chart\"><canvas id=\"chart\"></canvas></div>\n<noscript><p>The chart needs JavaScript; the tables do not.</p></noscript>\n";
  for (const CompareSection& section : compare_sections(report))
    page += fmt::format("<h2>{}</h2>\n<p>{}</p>\n{}", html_text(section.title), html_text(section.caption), html_table(section.table));
  page += pictures(report);
  page += fmt::format("<script type=\"application/json\" id=\"report\">{}</script>\n<!-- Chart.js:\n{}\n-->\n<script>{}</script>\n<script>{}</script>\n</body></html>\n", script_json(compare_json(report)),
                      page_file("chart.LICENSE.md"), without_map(page_file("chart.umd.js")), page_file("compare.js"));
  return page;
}

}  // namespace quincunx

#include "verify/svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "verify/report_text.hpp"
#include "verify/svg_axis.hpp"

namespace courant::report {
namespace {

// Of letters of the size chart_letters, in a broad face: mean of words, and digits.
constexpr Real plot_top = 30, plot_height = 225, row = 21;
constexpr int colours = 7;  // of the style sheet

/// Where things are on the drawing.
struct Drawing {
  Axis x, y;
  Real left = 0, right = 0;
  Real bottom() const { return plot_top + plot_height; }
  Real at_x(Real v) const { return left + x.place(v) * (right - left); }
  Real at_y(Real v) const { return bottom() - y.place(v) * plot_height; }
  bool shows(const ChartPoint& p) const { return x.shows(p.x) && y.shows(p.y); }
  // Of what has no place: near the beginning of the axis, or its end for what is too large or not a number.
  Real edge_x(Real v) const { return x.shows(v) ? at_x(v) : v <= 0 ? left + 10 : right - 10; }
  Real edge_y(Real v) const { return y.shows(v) ? at_y(v) : v <= 0 ? bottom() - 10 : plot_top + 10; }
};

std::string marker_shape(std::size_t index, Real x, Real y, Real r) {
  static constexpr std::array<std::string_view, 8> outlines = {
      "",                                                                            // circle
      "M-.9-.9h1.8v1.8h-1.8z",                                                       // square
      "M0-1.2L1.1.8H-1.1z",                                                          // triangle
      "M0-1.3L1.3 0 0 1.3-1.3 0z",                                                   // diamond
      "M0 1.2L1.1-.8H-1.1z",                                                         // triangle, point down
      "M-.4-1.2h.8v.8h.8v.8h-.8v.8h-.8v-.8h-.8v-.8h.8z",                             // plus
      "M-1.2-.5L-.5-1.2 0-.6.5-1.2 1.2-.5.6 0 1.2.5.5 1.2 0 .6-.5 1.2-1.2.5-.6 0z",  // cross
      "M0-1.3L1.2-.4.8 1H-.8L-1.2-.4z"};                                             // pentagon
  const std::string_view outline = outlines[index % outlines.size()];
  if (outline.empty()) return fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:.1f}")", x, y, r);
  return fmt::format(R"svg(<path d="{}" transform="translate({:.1f} {:.1f}) scale({:.1f})")svg", outline, x,
                     y, r);
}

std::string title_of(const std::string& hover) {
  return hover.empty() ? "" : "<title>" + escape_xml(hover) + "</title>";
}

std::string marker(std::size_t index, Real x, Real y, const std::string& hover) {
  const std::string shape = marker_shape(index, x, y, 4.6);
  const std::string tag = shape.substr(1, shape.find(' ') - 1);
  return fmt::format("{} class=\"mark\">{}</{}>", shape, title_of(hover), tag);
}

std::string text_at(Real x, Real y, std::string_view anchor, std::string_view text,
                    std::string_view more = {}) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}"{}>{}</text>)", x, y, anchor, more,
                     escape_xml(text));
}

/// Lines of the grid with their numbers; numbers along x that would touch each other are thinned out.
std::string grid(const Drawing& d) {
  std::string out = R"(<g class="grid">)";
  for (const Axis::Tick& t : d.y.ticks)
    out += fmt::format(R"(<path d="M{:.1f} {:.1f}H{:.1f}"/>)", d.left, d.at_y(t.value), d.right);
  for (const Axis::Tick& t : d.x.ticks)
    out += fmt::format(R"(<path d="M{:.1f} {:.1f}V{:.1f}"/>)", d.at_x(t.value), plot_top, d.bottom());
  out += "</g>";
  for (const Axis::Tick& t : d.y.ticks) out += text_at(d.left - 6, d.at_y(t.value) + 4.5, "end", t.label);
  Real taken = -1e9;
  for (const Axis::Tick& t : d.x.ticks) {
    const Real half = digit_width * static_cast<Real>(length(t.label)) / 2;
    const Real middle = std::clamp(d.at_x(t.value), half, chart_width - half - 1);
    if (middle - half < taken + 8) continue;
    taken = middle + half;
    out += text_at(middle, d.bottom() + 18, "middle", t.label);
  }
  return out + fmt::format(R"(<path class="frame" d="M{:.1f} {:.1f}V{:.1f}H{:.1f}"/>)", d.left, plot_top,
                           d.bottom(), d.right);
}

/// The lines through those points in a row that have a place.
std::string path_through(const Drawing& d, const std::vector<ChartPoint>& points) {
  std::string path;
  bool pen_down = false;
  for (const ChartPoint& p : points) {
    const bool shown = d.shows(p);
    if (shown) path += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", d.at_x(p.x), d.at_y(p.y));
    pen_down = shown;
  }
  return path;
}

/// A point that has no place on the axes: at the edge, with an arrow and its value.
std::string stray(const Drawing& d, const ChartPoint& p, std::size_t index) {
  const bool high = !(p.y <= 0);
  const bool y_off = !d.y.shows(p.y);
  const Real x = d.edge_x(p.x), y = d.edge_y(p.y);
  std::string out = marker(index, x, y, p.hover);
  if (y_off) {
    const std::string_view arrow = high ? "m-3.5 3.5L0 0 3.5 3.5M0 0V6" : "m-3.5-3.5L0 0 3.5-3.5M0 0V-6";
    out += fmt::format(R"svg(<path class="arrow" transform="translate({:.1f} {:.1f})" d="M0 0{}"/>)svg", x,
                       high ? plot_top - 2 : d.bottom() + 1, arrow);
  }
  const std::string value = y_off ? (std::isnan(p.y)   ? "NaN"
                                     : std::isinf(p.y) ? "inf"
                                                       : number(p.y, 2))
                                  : "time " + number(p.x, 2);
  const bool at_right = x > d.right - 60;
  return out + text_at(at_right ? x - 8 : x + 8, y + 4.5, at_right ? "end" : "start", value);
}

std::string series_markers(const Drawing& d, const ChartSeries& s, std::size_t index) {
  std::string out;
  std::size_t stride = 1, first = 0;
  if (s.style == ChartSeries::Style::line && s.points.size() > 12) {
    stride = s.points.size() / 6;
    first =
        stride * (index % 4) / 4;  // or the markers of lines that lie on each other would hide one another
  }
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    const ChartPoint& p = s.points[i];
    if (!d.shows(p)) {
      if (s.style == ChartSeries::Style::joined_markers) out += stray(d, p, index);
    } else if (i % stride == first && s.style != ChartSeries::Style::reference_line) {
      out += s.style == ChartSeries::Style::reference_dots
                 ? fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="4.2">{}</circle>)", d.at_x(p.x),
                               d.at_y(p.y), title_of(p.hover))
                 : marker(index, d.at_x(p.x), d.at_y(p.y), p.hover);
    }
  }
  return out;
}

std::string class_of(const ChartSeries& s, std::size_t index) {
  switch (s.style) {
    case ChartSeries::Style::reference_line:
      return "reference";
    case ChartSeries::Style::reference_dots:
      return "reference dots";
    default:
      break;
  }
  return fmt::format("s{}{}", index % colours, index >= 8 ? " again" : "");
}

std::string draw_series(const Drawing& d, const ChartSeries& s, std::size_t index) {
  std::string out = fmt::format(R"(<g class="{}">)", class_of(s, index));
  if (s.style != ChartSeries::Style::reference_dots)
    out += fmt::format(R"(<path class="line" d="{}">{}</path>)", path_through(d, s.points), title_of(s.name));
  return out + series_markers(d, s, index) + "</g>";
}

std::string draw_front(const Drawing& d, const std::vector<ChartPoint>& front) {
  if (front.empty()) return {};
  std::string out = fmt::format(R"(<g class="front"><path d="{}"/>)", path_through(d, front));
  for (const ChartPoint& p : front)
    out += fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="9"/>)", d.edge_x(p.x), d.edge_y(p.y));
  return out + "</g>";
}

/// One entry of the legend: what is drawn to the left of its name.
struct Entry {
  std::string sample, name;  ///< sample: around (13, 0)
};

std::vector<Entry> entries_of(const Chart& chart) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const ChartSeries& s = chart.series[i];
    const bool dots = s.style == ChartSeries::Style::reference_dots;
    std::string sample = fmt::format(R"(<g class="{}">)", class_of(s, i));
    if (!dots) sample += R"(<path class="line" d="M0 0H26"/>)";
    if (dots) sample += R"(<circle cx="13" cy="0" r="4.2"/>)";
    if (!dots && s.style != ChartSeries::Style::reference_line) sample += marker(i, 13, 0, {});
    entries.push_back({sample + "</g>", s.name});
  }
  if (!chart.front.empty())
    entries.push_back(
        {R"(<g class="front"><path d="M0 0H26"/><circle cx="13" cy="0" r="8"/></g>)", chart.front_name});
  for (const Chart::Level& level : chart.levels)
    entries.push_back({R"(<path class="bound" d="M0 0H26"/>)", level.name});
  return entries;
}

/// Entries side by side where they fit; moves `y` to below the last row.
std::string legend(const Chart& chart, Real& y) {
  std::string out;
  Real x = 8;
  for (const Entry& e : entries_of(chart)) {
    const std::string name = shorten(e.name, 50);
    const Real width = 34 + letter_width * static_cast<Real>(length(name)) + 22;
    if (x > 8 && x + width > chart_width) x = 8, y += row;
    out += fmt::format(R"svg(<g transform="translate({:.1f} {:.1f})">{}{}{}</g>)svg", x, y, e.sample,
                       name == e.name ? "" : title_of(e.name), text_at(33, 4.5, "start", name));
    x += width;
  }
  y += row - 8;
  return out;
}

Drawing lay_out(const Chart& chart) {
  std::vector<Real> xs, ys;
  for (const ChartSeries& s : chart.series)
    for (const ChartPoint& p : s.points) xs.push_back(p.x), ys.push_back(p.y);
  for (const Chart::Level& level : chart.levels) ys.push_back(level.y);
  Drawing d;
  d.x = make_axis(chart.log_x, xs);
  d.y = make_axis(chart.log_y, ys, chart.percent_y);
  std::size_t longest = 2;
  for (const Axis::Tick& t : d.y.ticks) longest = std::max(longest, length(t.label));
  d.left = std::min<Real>(10 + digit_width * static_cast<Real>(longest), 140);
  d.right = chart_width - 14;
  return d;
}

}  // namespace

std::string svg_chart(const Chart& chart) {
  const Drawing d = lay_out(chart);
  std::string body = grid(d) + text_at(2, 16, "start", shorten(chart.y_label, 54)) +
                     text_at(d.right, d.bottom() + 38, "end", shorten(chart.x_label, 50));
  body += draw_front(d, chart.front);
  for (const Chart::Level& level : chart.levels)
    if (d.y.shows(level.y))
      body += fmt::format(R"(<path class="bound" d="M{:.1f} {:.1f}H{:.1f}">{}</path>)", d.left,
                          d.at_y(level.y), d.right, title_of(level.name));
  for (std::size_t i = 0; i < chart.series.size(); ++i) body += draw_series(d, chart.series[i], i);
  Real y = d.bottom() + 60;
  body += legend(chart, y);
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" class="chart" viewBox="0 0 {0} {1:.0f}" width="{0}" height="{1:.0f}" role="img" aria-label="{2}"><rect class="paper" width="{0}" height="{1:.0f}"/>{3}</svg>)",
      chart_width, y, escape_xml(chart.label), body);
}

std::string standalone_svg(std::string_view svg) {
  const std::size_t head = svg.find('>');  // text in attributes is escaped: the first one ends the tag
  std::string out(svg.substr(0, head + 1));
  (((out += "<style>") += chart_style()) += "</style>") += svg.substr(head + 1);
  return out + "\n";
}

}  // namespace courant::report

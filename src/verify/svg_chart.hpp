#pragma once
// Line charts as SVG, without any script: they scale with the page, can be read without colours (each line
// has a marker of its own), fit light and dark pages, and tell their numbers when pointed at.
#include <string>
#include <string_view>
#include <vector>

#include "base/real.hpp"

namespace courant::report {

/// Of letters and digits in the page's font, in the units of a chart, for room beside them.
inline constexpr Real letter_width = 7.3, digit_width = 8.6;

struct ChartPoint {
  Real x = 0, y = 0;
  std::string hover{};  ///< what is told when the point is pointed at
};

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points{};
  enum class Style {
    joined_markers,  ///< a marker at each point, joined by a line
    line,            ///< a line with a few markers
    reference_line,  ///< dashed, in the colour of the text
    reference_dots   ///< circles in the colour of the text
  } style = Style::joined_markers;
};

struct Chart {
  std::string label;  ///< for those who cannot see the chart
  std::string x_label, y_label;
  bool log_x = false, log_y = false;
  bool percent_y = false;  ///< y is a fraction that is told in per cent
  std::vector<ChartSeries> series;
  std::vector<ChartPoint> front;  ///< drawn as a broad light line and rings below the series; empty: none
  std::string front_name = "best error for the time";
  /// Horizontal dashed lines.
  struct Level {
    std::string name;
    Real y = 0;
  };
  std::vector<Level> levels;
};

/// The chart as one `svg` element whose classes chart_style() explains. Points without a place on the axes
/// are not dropped: zero and negative values on a logarithmic axis stand at its beginning with an arrow and
/// their value, infinite ones and what is not a number at its end. Any text is allowed in names.
std::string svg_chart(const Chart& chart);

/// Style sheet of the charts' classes, for the page they stand in.
std::string_view chart_style();

/// A file of its own: the `svg` element with the style sheet inside.
std::string standalone_svg(std::string_view svg);

/// Width of the charts' coordinates, and the size of their letters in them: shown 345 pixels wide or more,
/// the letters are at least 11 pixels high.
inline constexpr int chart_width = 420;
inline constexpr Real chart_letters = 13.5;

}  // namespace courant::report

#pragma once
// Pictures from the tables of analyses, with references beside them.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.hpp"
#include "post/results.hpp"
#include "post/table.hpp"
#include "post/yaml_map.hpp"

namespace courant {

/// A curve from a table: x and y are expressions over its columns.
struct FigureCurve {
  std::string table, x, y, each, label, style = "line";  ///< each: a column; one curve for each of its values
  Location where;
};

/// A curve or points that others found, or a straight line across the figure.
struct FigureReference {
  std::string label, style = "line";
  std::vector<Real> x, y;
  char across = ' ';  ///< 'x': upright at x[0]; 'y': level at y[0]
};

/// A field of an image as colours, with streamlines.
struct FigureMap {
  std::string image, field, label;
  std::vector<std::string> streamlines;  ///< two fields, or none
  std::optional<std::pair<Real, Real>> range;
  Location where;
};

struct Figure {
  std::string name, title, x_label, y_label, scale = "linear";
  std::optional<std::pair<Real, Real>> x_range, y_range;
  std::vector<FigureCurve> curves;
  std::vector<FigureReference> references;
  std::optional<FigureMap> map;
  bool walls = false, equal = false;  ///< traces of the shells; the same scale on both axes
};

Figure read_figure(const MapReader& parent, const YAML::Node& node);

/// All figures with their numbers as JSON for the plot script. What a figure names but is not there is
/// reported.
std::string figures_json(const std::vector<Figure>& figures, const std::vector<PostTable>& tables,
                         const std::vector<PostImage>& images, const std::vector<WallLine>& walls,
                         const std::vector<std::string>& formats, const std::string& title,
                         Diagnostics& diagnostics);

/// A text as a JSON string.
std::string json_quoted(const std::string& text);

}  // namespace courant

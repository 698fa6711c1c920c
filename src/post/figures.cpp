#include "post/figures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

#include "base/compiled_expression.hpp"
#include "post/analysis.hpp"

namespace courant {
namespace {

const std::vector<std::string> styles = {"line", "dashed", "points", "line+points"};

std::string read_style(const MapReader& map) {
  return styles[read_choice(map, "style", styles)];
}

FigureCurve read_curve(const MapReader& map) {
  FigureCurve out;
  map.allow({"table", "x", "y", "each", "label", "style"});
  map.text("table", out.table, true);
  map.text("x", out.x, true);
  map.text("y", out.y, true);
  map.text("each", out.each);
  map.text("label", out.label);
  out.style = read_style(map);
  out.where = map.where(map.node());
  return out;
}

/// {formula: exp(-0.028 * x), from: 0, to: 40}, {points: [[x, y], ...]}, {x: 3.5} or {y: 1}
FigureReference read_reference(const MapReader& map) {
  FigureReference out;
  map.allow({"formula", "from", "to", "points", "x", "y", "label", "style"});
  map.text("label", out.label);
  out.style = read_style(map);
  int ways = 0;
  for (const char* key : {"formula", "points", "x", "y"}) ways += map.has(key);
  if (ways != 1) {
    map.error(map.node(), fmt::format("'{}' needs one of formula, points, x and y", map.name()),
              "for example {formula: exp(-0.028 * x), from: 0, to: 40}, {points: [[3.4, 0.342]]} or {y: 1}");
    return out;
  }
  map.list("points", [&](const YAML::Node& node) {
    if (!node.IsSequence() || node.size() != 2) return map.error(node, "a point has two numbers");
    map.scalar(node[0], "points", out.x.emplace_back());
    map.scalar(node[1], "points", out.y.emplace_back());
  });
  if (map.has("x")) out.across = 'x', map.number("x", out.x.emplace_back());
  if (map.has("y")) out.across = 'y', map.number("y", out.y.emplace_back());
  const auto formula = map.get("formula", false);
  if (!formula) return out;
  Real from = 0, to = 0;
  map.number("from", from, true);
  map.number("to", to, true);
  const CompiledExpression of = read_expression(map, *formula, "formula", {"x"});
  constexpr int steps = 200;
  for (int k = 0; k <= steps && of.ok(); ++k) {
    out.x.push_back(from + (to - from) * k / steps);
    out.y.push_back(of(&out.x.back()));
  }
  return out;
}

FigureMap read_map(const MapReader& map) {
  FigureMap out;
  map.allow({"image", "field", "label", "streamlines", "range"});
  map.text("image", out.image, true);
  map.text("field", out.field, true);
  map.text("label", out.label);
  out.range = read_range(map, "range");
  map.list("streamlines",
           [&](const YAML::Node& node) { out.streamlines.push_back(node.IsScalar() ? node.Scalar() : ""); });
  if (!out.streamlines.empty() && out.streamlines.size() != 2)
    map.error(*map.get("streamlines", false), fmt::format("'{}.streamlines' must be two fields", map.name()),
              "for example [vx_mean, vy_mean]");
  out.where = map.where(map.node());
  return out;
}

void read_flag(const MapReader& map, const char* key, bool& value) {
  const auto node = map.get(key, false);
  if (node && (!node->IsScalar() || !YAML::convert<bool>::decode(*node, value)))
    map.error(*node, fmt::format("'{}.{}' must be true or false", map.name(), key));
}

void append_numbers(std::string& out, const char* key, const std::vector<Real>& values) {
  fmt::memory_buffer text;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]))
      fmt::format_to(std::back_inserter(text), "{}{:.7g}", i ? "," : "", values[i]);
    else
      fmt::format_to(std::back_inserter(text), "{}null", i ? "," : "");
  out += fmt::format("\"{}\": [{}]", key, fmt::to_string(text));
}

std::string range_text(const std::optional<std::pair<Real, Real>>& range) {
  return range ? fmt::format("[{:g}, {:g}]", range->first, range->second) : "null";
}

bool is_word(const std::string& name) {
  return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

/// Puts the values of a curve, or of several, into the JSON text.
class CurveWriter {
 public:
  CurveWriter(const FigureCurve& curve, const PostTable& table) : curve_(curve), table_(table) {
    for (const PostColumn& column : table.columns)
      if (is_word(column.name)) names_.push_back(column.name), columns_.push_back(&column.values);
  }
  void write(std::string& out, const char*& comma, Diagnostics& diagnostics) {
    const auto x = values(curve_.x, "x", diagnostics), y = values(curve_.y, "y", diagnostics);
    const PostColumn* each = curve_.each.empty() ? nullptr : table_.find(curve_.each);
    if (!curve_.each.empty() && !each)
      diagnostics.error(curve_.where,
                        fmt::format("the table '{}' has no column '{}'", table_.name, curve_.each),
                        fmt::format("it has {}", fmt::join(names_, ", ")));
    if (!x || !y || (!curve_.each.empty() && !each)) return;
    std::vector<Real> keys = each ? each->values : std::vector<Real>{0};
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    bool first = true;
    for (Real key : keys) {
      std::vector<Real> xs, ys;
      for (std::size_t i = 0; i < table_.rows(); ++i)
        if (!each || each->values[i] == key) xs.push_back((*x)[i]), ys.push_back((*y)[i]);
      out += comma + fmt::format("{{\"label\": {}, \"style\": {}, ", json_quoted(first ? curve_.label : ""),
                                 json_quoted(curve_.style));
      if (each) out += fmt::format("\"each\": {:.7g}, ", key);
      append_numbers(out, "x", xs);
      out += ", ";
      append_numbers(out, "y", ys);
      out += "}";
      comma = ", ", first = false;
    }
  }

 private:
  /// A column by its name, which may be no word ("depth@0.5"), or an expression over columns.
  std::optional<std::vector<Real>> values(const std::string& text, const char* key,
                                          Diagnostics& diagnostics) const {
    if (const PostColumn* column = table_.find(text)) return column->values;
    const CompiledExpression of(text, names_);
    if (!of.ok()) {
      diagnostics.error(curve_.where,
                        fmt::format("'{}' of a curve from '{}': {}", key, table_.name, of.error()),
                        fmt::format("the table has {}", fmt::join(names_, ", ")));
      return std::nullopt;
    }
    std::vector<Real> out, row(columns_.size());
    for (std::size_t i = 0; i < table_.rows(); ++i) {
      for (std::size_t c = 0; c < row.size(); ++c) row[c] = (*columns_[c])[i];
      out.push_back(of(row.data()));
    }
    return out;
  }
  const FigureCurve& curve_;
  const PostTable& table_;
  std::vector<std::string> names_;
  std::vector<const std::vector<Real>*> columns_;
};

template <class T>
const T* find_named(const std::vector<T>& all, const std::string& name, const char* what,
                    const Location& where, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const T& one : all) {
    if (one.name == name) return &one;
    names.push_back(one.name);
  }
  diagnostics.error(where, fmt::format("there is no {} '{}' for the figure", what, name),
                    fmt::format("there are: {}", fmt::join(names, ", ")));
  return nullptr;
}

std::string map_json(const FigureMap& map, const PostImage& image, Diagnostics& diagnostics) {
  std::string out = fmt::format(
      "{{\"nx\": {}, \"ny\": {}, \"x0\": {:.9g}, \"y0\": {:.9g}, \"dx\": {:.9g}, \"dy\": {:.9g}, \"label\": "
      "{}, "
      "\"range\": {}",
      image.n[0], image.n[1], image.origin[0], image.origin[1], image.spacing[0], image.spacing[1],
      json_quoted(map.label), range_text(map.range));
  std::vector<std::pair<const char*, std::string>> wanted{{"field", map.field}};
  if (map.streamlines.size() == 2) {
    wanted.emplace_back("u", map.streamlines[0]);
    wanted.emplace_back("v", map.streamlines[1]);
  }
  for (const auto& [key, name] : wanted) {
    const PostColumn* field = find_named(image.fields, name, "field", map.where, diagnostics);
    if (!field) return "null";
    out += ", ";
    // the lowest layer of a grid in space
    append_numbers(out, key,
                   {field->values.begin(),
                    field->values.begin() + static_cast<std::ptrdiff_t>(image.n[0]) * image.n[1]});
  }
  return out + "}";
}

}  // namespace

Figure read_figure(const MapReader& parent, const YAML::Node& node) {
  Figure out;
  const MapReader map = parent.element(node, "figures");
  map.allow({"name", "title", "x_label", "y_label", "x_range", "y_range", "scale", "curves", "references",
             "map", "walls", "equal"});
  map.text("name", out.name, true);
  map.text("title", out.title);
  map.text("x_label", out.x_label);
  map.text("y_label", out.y_label);
  out.x_range = read_range(map, "x_range");
  out.y_range = read_range(map, "y_range");
  const std::vector<std::string> scales = {"linear", "log_x", "log_y", "log"};
  out.scale = scales[read_choice(map, "scale", scales)];
  map.list("curves",
           [&](const YAML::Node& one) { out.curves.push_back(read_curve(map.element(one, "curves"))); });
  map.list("references", [&](const YAML::Node& one) {
    out.references.push_back(read_reference(map.element(one, "references")));
  });
  if (const auto field = map.map("map")) out.map = read_map(*field);
  read_flag(map, "walls", out.walls);
  read_flag(map, "equal", out.equal);
  if (node.IsMap() && out.curves.empty() && !out.map)
    map.error(node, fmt::format("the figure '{}' shows nothing", out.name), "add curves or a map");
  return out;
}

std::string json_quoted(const std::string& text) {
  std::string out = "\"";
  for (unsigned char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c < 0x20 ? ' ' : static_cast<char>(c);
  }
  return out + '"';
}

std::string figures_json(const std::vector<Figure>& figures, const std::vector<PostTable>& tables,
                         const std::vector<PostImage>& images, const std::vector<WallLine>& walls,
                         const std::vector<std::string>& formats, const std::string& title,
                         Diagnostics& diagnostics) {
  std::vector<std::string> quoted_formats;
  for (const std::string& format : formats) quoted_formats.push_back(json_quoted(format));
  std::string out = fmt::format("{{\"title\": {}, \"formats\": [{}], \"walls\": [", json_quoted(title),
                                fmt::join(quoted_formats, ", "));
  const char* comma = "";
  for (const WallLine& wall : walls) {
    out += fmt::format("{}[{:.6g},{:.6g},{:.6g},{:.6g}]", comma, wall[0], wall[1], wall[2], wall[3]);
    comma = ",";
  }
  out += "],\n\"figures\": [";
  comma = "";
  for (const Figure& figure : figures) {
    out += fmt::format(
        "{}\n{{\"name\": {}, \"title\": {}, \"x_label\": {}, \"y_label\": {}, \"scale\": \"{}\", "
        "\"x_range\": {}, "
        "\"y_range\": {}, \"walls\": {}, \"equal\": {}, \"curves\": [",
        comma, json_quoted(figure.name), json_quoted(figure.title), json_quoted(figure.x_label),
        json_quoted(figure.y_label), figure.scale, range_text(figure.x_range), range_text(figure.y_range),
        figure.walls, figure.equal);
    comma = "";
    for (const FigureCurve& curve : figure.curves)
      if (const PostTable* table = find_named(tables, curve.table, "table", curve.where, diagnostics))
        CurveWriter(curve, *table).write(out, comma, diagnostics);
    out += "], \"references\": [";
    comma = "";
    for (const FigureReference& reference : figure.references) {
      out += fmt::format("{}{{\"label\": {}, \"style\": {}, \"across\": \"{}\", ", comma,
                         json_quoted(reference.label), json_quoted(reference.style), reference.across);
      append_numbers(out, "x", reference.x);
      out += ", ";
      append_numbers(out, "y", reference.y);
      out += "}";
      comma = ", ";
    }
    out += "], \"map\": ";
    const PostImage* image =
        figure.map ? find_named(images, figure.map->image, "grid", figure.map->where, diagnostics) : nullptr;
    out += (image ? map_json(*figure.map, *image, diagnostics) : "null") + "}";
    comma = ",";
  }
  return out + "]}\n";
}

}  // namespace courant

#include "post/ascii_history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "base/nearest_word.hpp"
#include "post/ascii_reader.hpp"

namespace courant {
namespace {

constexpr const char* known_kinds =
    "glstat, matsum, rcforc, sleout, nodout, rbdout, bndout, spcforc, rwforc and sphout are read";

/// The lines of a file in order; each without its end.
struct Lines {
  std::vector<std::string> text;
  bool ends_whole = true;  // the last one has a line end
};

std::optional<Lines> read_lines(const std::filesystem::path& file, Diagnostics& diagnostics) {
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(file, ignored)) {
    diagnostics.error(
        {file.string()}, "cannot read the history",
        "a name alone is a file in the folder of results; a path counts from the recipe's folder");
    return std::nullopt;
  }
  Lines out;
  for (std::string line; std::getline(stream, line);) {
    out.ends_whole = !stream.eof();
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.find('\0') != std::string::npos) {
      diagnostics.error({file.string(), static_cast<int>(out.text.size()) + 1}, "this is no text file",
                        known_kinds);
      return std::nullopt;
    }
    out.text.push_back(std::move(line));
  }
  return out;
}

const AsciiKind* kind_of(const Lines& lines) {
  for (const std::string& line : lines.text)
    for (const AsciiKind& kind : ascii_kinds())
      if (kind.is_told_by(line)) return &kind;
  return nullptr;
}

/// Throws AsciiFault. `at`: the line that is being read.
void read_states(const Lines& lines, AsciiReader& reader, AsciiStates& states, std::size_t& at) {
  bool legend = false;
  for (at = 0; at < lines.text.size(); ++at) {
    const std::string& line = lines.text[at];
    if (line.starts_with("{BEGIN LEGEND}")) legend = true;
    if (!legend && (at + 1 < lines.text.size() || lines.ends_whole)) reader.line(line, states);
    if (line.starts_with("{END LEGEND}")) legend = false;
  }
  --at;
  if (!lines.ends_whole) throw AsciiFault("the file is cut off within this line");
  reader.end();
  const std::size_t n = states.times().size();
  if (n > 1 && states.size_of(n - 1) < states.size_of(n - 2))
    throw AsciiFault(
        fmt::format("the file is cut off: its last state, at time {:.6g}, has {} numbers, the one "
                    "before it {}",
                    states.time(), states.size_of(n - 1), states.size_of(n - 2)));
}

bool fits(const AsciiKey& asked, const AsciiKey& is) {
  if (asked.name != is.name || (asked.id && asked.id != is.id)) return false;
  return asked.side.empty() || asked.side == is.side ||
         (" " + is.side + " ").find(" " + asked.side + " ") != std::string::npos;
}

/// "1 SURFA", "12", "velocity": what a series belongs to.
std::string owner(const AsciiKey& key) {
  const std::string id = key.id ? std::to_string(*key.id) : "";
  return id + (!id.empty() && !key.side.empty() ? " " : "") + key.side;
}

/// A few of many names.
std::string some(const std::set<std::string>& names) {
  constexpr std::size_t most = 12;
  std::vector<std::string> shown;
  for (const std::string& name : names)
    if (shown.size() < most && !name.empty()) shown.push_back(name);
  return fmt::format("{}{}", fmt::join(shown, ", "), names.size() > most ? ", ..." : "");
}

struct NamedDimension {
  const char *kind, *ending, *dimension;  // the first that fits counts
};
constexpr const char *energy = "ML2/T2", *force = "ML/T2";
constexpr NamedDimension dimensions[] = {
    {"", "cycle", "-"},
    {"glstat", "time step", "T"},
    {"glstat", "nanosec)", "ns"},
    {"glstat", "initial energy", "-"},
    {"glstat", "w/o eroded energy", "-"},
    {"glstat", "energy", energy},
    {"glstat", "work", energy},
    {"glstat", "velocity", "L/T"},
    {"glstat", "added mass", "M"},
    {"glstat", "percentage increase", "%"},
    {"matsum", "-mom", "ML/T"},
    {"matsum", "-rbv", "L/T"},
    {"matsum", "+mass", "M"},
    {"matsum", "inten", energy},
    {"matsum", "kinen", energy},
    {"matsum", "hgeng", energy},
    {"matsum", "eroded_ie", energy},
    {"matsum", "eroded_ke", energy},
    {"matsum", "eroded_he", energy},
    {"rcforc", "mass", "M"},
    {"rcforc", "mx", energy},
    {"rcforc", "my", energy},
    {"rcforc", "mz", energy},
    {"rcforc", "x", force},
    {"rcforc", "y", force},
    {"rcforc", "z", force},
    {"sleout", "", energy},
    {"nodout", "-disp", "L"},
    {"nodout", "-vel", "L/T"},
    {"nodout", "-accl", "L/T2"},
    {"nodout", "-coor", "L"},
    {"nodout", "-rot", "-"},
    {"nodout", "-rot vel", "1/T"},
    {"nodout", "-rot acc", "1/T2"},
    {"bndout", "moment", energy},
    {"bndout", "energy", energy},
    {"bndout", "etotal", energy},
    {"bndout", "", force},
    {"rwforc", "", force},
    {"sphout", "density", "M/L3"},
    {"sphout", "smooth", "L"},
    {"sphout", "neigh", "-"},
    {"sphout", "act", "-"},
    {"sphout", "yield", "M/LT2"},
    {"sphout", "effsg", "M/LT2"},
};

std::string dimension_of(const std::string& kind, const std::string& name) {
  for (const NamedDimension& known : dimensions)
    if ((!*known.kind || kind == known.kind) && name.ends_with(known.ending)) return known.dimension;
  const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
  if (kind == "spcforc") return has("moment") ? energy : force;
  if (kind == "sphout") return has("sig-") ? "M/LT2" : has("eps-") ? "-" : "?";
  if (kind != "rbdout") return "?";
  const bool turns = name.ends_with("-rot");
  if (has("coordinates")) return "L";
  if (has("displacements")) return turns ? "-" : "L";
  if (has("velocities")) return turns ? "1/T" : "L/T";
  if (has("accelerations")) return turns ? "1/T2" : "L/T2";
  return "-";  // directions
}

}  // namespace

std::optional<AsciiFile> AsciiFile::open(const std::filesystem::path& file, Diagnostics& diagnostics) {
  const auto lines = read_lines(file, diagnostics);
  if (!lines) return std::nullopt;
  const AsciiKind* kind = kind_of(*lines);
  if (!kind) {
    diagnostics.error({file.string(), static_cast<int>(lines->text.size())},
                      "up to its end the file has no state of a history", known_kinds);
    return std::nullopt;
  }
  AsciiStates states;
  std::size_t at = 0;
  try {
    read_states(*lines, *kind->make(), states, at);
  } catch (const AsciiFault& fault) {
    diagnostics.error(
        {file.string(), static_cast<int>(at) + 1},
        fmt::format("not a line of a whole {}: {}", kind->name, fault.what()),
        "if the run that writes it goes on, wait for its end; else take off the last, broken state");
    return std::nullopt;
  }
  if (states.dropped() > 0)
    diagnostics.warning({file.string()},
                        fmt::format("times go back, as where a run was restarted: {} states before that were "
                                    "replaced by later ones",
                                    states.dropped()));
  AsciiFile out;
  out.kind_ = kind->name;
  out.t_ = states.times();
  out.columns_ = states.take_columns();
  return out;
}

const AsciiColumn* AsciiFile::find(const AsciiKey& key, std::string& why, std::string& hint) const {
  AsciiKey asked = key;
  if (kind_ == "sleout" && asked.name == "total friction") asked.name = "friction energy";
  if (asked.side == "slave") asked.side = "SURFA";
  if (asked.side == "master") asked.side = "SURFB";
  std::vector<const AsciiColumn*> found;
  std::set<std::string> names, owners, all_owners;
  for (const AsciiColumn& column : columns_) {
    names.insert(column.key.name);
    if (column.key.name == asked.name) all_owners.insert(owner(column.key));
    if (!fits(asked, column.key)) continue;
    found.push_back(&column);
    owners.insert(owner(column.key));
  }
  if (found.size() == 1) return found[0];
  const std::string whose = owner(asked);
  if (found.size() > 1) {
    why = fmt::format("{} has several '{}'{}", kind_, asked.name, whose.empty() ? "" : " of " + whose);
    hint = fmt::format("tell id, or side: {}", some(owners));
  } else if (!all_owners.empty()) {
    why = fmt::format("{} has no '{}' of {}", kind_, asked.name, whose);
    hint = all_owners == std::set<std::string>{""} ? "it belongs to the whole: without id and side"
                                                   : fmt::format("it has that of {}", some(all_owners));
  } else {
    const std::string near = nearest_word(asked.name, {names.begin(), names.end()});
    why = fmt::format("{} has no '{}'", kind_, asked.name);
    hint = near.empty() ? fmt::format("it has {}", some(names)) : fmt::format("did you mean '{}'?", near);
  }
  return nullptr;
}

std::string AsciiFile::dimension(const AsciiColumn& column) const {
  return dimension_of(kind_, column.key.name);
}

}  // namespace courant

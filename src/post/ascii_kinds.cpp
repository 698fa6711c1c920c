// One reader for each kind of ASCII history. Layouts: those that LS-DYNA R16 prints and those of LSTC's
// converter from binout.
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "post/ascii_reader.hpp"

namespace courant {
namespace {

bool has(std::string_view text, std::string_view word) {
  return text.find(word) != std::string_view::npos;
}

/// What stands behind `word`. Throws AsciiFault where it is not there.
std::string_view behind(std::string_view text, std::string_view word) {
  const std::size_t at = text.find(word);
  if (at == std::string_view::npos) throw AsciiFault("'" + std::string(word) + "' is missing");
  return text.substr(at + word.size());
}

Real number_behind(std::string_view text, std::string_view word, std::size_t width, const char* what) {
  std::string_view rest = behind(text, word);
  Real value = 0;
  if (!take_number(rest, value, width)) throw AsciiFault(std::string("no number for the ") + what);
  return value;
}

/// A time must be a number: states could not be told apart.
Real time_behind(std::string_view text, std::string_view word, std::size_t width) {
  const Real t = number_behind(text, word, width, "time");
  if (!std::isfinite(t)) throw AsciiFault("the time is no finite number");
  return t;
}

std::int64_t id_behind(std::string_view text, std::string_view word) {
  std::string_view rest = behind(text, word);
  std::int64_t id = 0;
  if (!take_id(rest, id)) throw AsciiFault("no id behind '" + std::string(stripped(word)) + "'");
  return id;
}

/// `name=number name=number ...` of one entity.
void put_pairs(std::string_view text, std::optional<std::int64_t> id, const std::string& side,
               AsciiStates& states) {
  while (has(text, "=")) {
    std::string_view name = stripped(text.substr(0, text.find('=')));
    const std::string_view rest = behind(text, "=");
    text = rest;
    Real value = 0;
    if (!take_number(text, value, 13)) throw AsciiFault("no number behind '" + std::string(name) + "='");
    if (name != "setid") states.put({std::string(name), id, side}, value);
  }
}

/// Exactly named numbers of one row; more may follow.
void put_row(std::string_view text, std::initializer_list<const char*> names, std::size_t width,
             const AsciiKey& key, AsciiStates& states) {
  const std::vector<Real> values = take_numbers(text, width);
  if (values.size() < names.size())
    throw AsciiFault("the row has " + std::to_string(values.size()) + " numbers where " +
                     std::to_string(names.size()) + " belong");
  const Real* value = values.data();
  for (const char* name : names) states.put({key.name + name, key.id, key.side}, *value++);
}

class Glstat : public AsciiReader {
  Real cycle_ = std::nan("");
  bool awaits_time_ = true;

 public:
  void line(std::string_view text, AsciiStates& states) override {
    if (text.starts_with(" dt of cycle")) {
      if (awaits_time_ && states.begun()) throw AsciiFault("the state before has no time");
      cycle_ = number_behind(text, "dt of cycle", 8, "cycle");
      awaits_time_ = true;
      return;
    }
    constexpr std::size_t end = 32;  // one blank, a label filled with dots to 31 characters
    if (text.size() <= end || text[0] != ' ' || text[end - 1] != '.') return;
    std::string_view name = text.substr(1, end - 1), rest = text.substr(end);
    while (!name.empty() && (name.back() == '.' || name.back() == ' ')) name.remove_suffix(1);
    Real value = 0;
    if (!take_number(rest, value, 14)) throw AsciiFault("no number for '" + std::string(name) + "'");
    if (name == "time") {
      if (!std::isfinite(value)) throw AsciiFault("the time is no finite number");
      states.begin(value);
      states.put({"cycle", {}}, cycle_);
      awaits_time_ = false;
      return;
    }
    if (awaits_time_) throw AsciiFault("'" + std::string(name) + "' stands before the time of its state");
    std::optional<std::int64_t> wall;
    if (has(rest, "wall#")) wall = id_behind(rest, "wall#");
    states.put({std::string(name), wall}, value);
  }
  void end() override {
    if (awaits_time_) throw AsciiFault("the file is cut off: its last state has no time");
  }
};

class Matsum : public AsciiReader {
  std::optional<std::int64_t> part_;

 public:
  void line(std::string_view text, AsciiStates& states) override {
    if (text.starts_with(" time =")) {
      part_.reset();
      return states.begin(time_behind(text, "time =", 13));
    }
    if (!has(text, "=")) return;
    if (text.starts_with(" mat.#=")) {
      std::string_view rest = behind(text, "mat.#=");
      std::int64_t id = 0;
      if (!take_id(rest, id)) throw AsciiFault("no id behind 'mat.#='");
      part_ = id;
      return put_pairs(rest, part_, "", states);
    }
    // notes on added mass have several words before their =
    const std::string_view first = stripped(text.substr(0, text.find('=')));
    if (part_ && !has(first, " ")) put_pairs(text, part_, "", states);
  }
};

class Rcforc : public AsciiReader {
 public:
  void line(std::string_view text, AsciiStates& states) override {
    std::string_view rest = stripped(text);
    const std::string_view word = rest.substr(0, rest.find(' '));
    const bool a = word == "SURFA" || word == "slave", b = word == "SURFB" || word == "master";
    if (!a && !b) return;
    rest.remove_prefix(word.size());
    std::int64_t id = 0;
    if (!take_id(rest, id)) return;  // a legend may have such a title
    if (!has(rest, "time")) throw AsciiFault("no time on this line");
    const Real t = time_behind(rest, "time", 12);
    rest = behind(rest, "time");
    Real again = 0;
    take_number(rest, again, 12);
    const std::string side = a ? "SURFA" : "SURFB";
    if (!states.begun() || states.time() != t || states.holds({"x", id, side})) states.begin(t);
    std::size_t count = 0;
    while (!(rest = stripped(rest)).empty()) {
      const std::string name(rest.substr(0, rest.find_first_of(" +-*0123456789")));
      rest.remove_prefix(name.size());
      Real value = 0;
      if (!take_number(rest, value, 12)) throw AsciiFault("no number behind '" + name + "'");
      states.put({name, id, side}, value);
      ++count;
    }
    if (count < 3) throw AsciiFault("a force has three components");
  }
};

class Sleout : public AsciiReader {
  bool rows_ = false, sums_ = false;

 public:
  void line(std::string_view text, AsciiStates& states) override {
    if (has(text, "contact interface energy file")) {
      rows_ = sums_ = false;
      return states.begin(time_behind(text, "time=", 14));
    }
    if (!states.begun()) return;
    if (has(text, "cycle=")) {
      rows_ = true;
      return states.put({"cycle", {}}, number_behind(text, "cycle=", 14, "cycle"));
    }
    if (stripped(text).starts_with("summary")) rows_ = false, sums_ = true;
    if (sums_ && has(text, "=")) {
      std::string name(stripped(text.substr(0, text.find('='))));
      if (name.starts_with("summary")) name = std::string(stripped(std::string_view(name).substr(7)));
      if (name == "total friction") name = "friction energy";
      return states.put({name, {}}, number_behind(text, "=", 14, name.c_str()));
    }
    if (!rows_ || stripped(text).empty()) return;
    std::string_view rest = text;
    std::int64_t id = 0;
    if (!take_id(rest, id)) return;
    const std::vector<Real> values = take_numbers(rest, 13);
    if (values.size() < 2) throw AsciiFault("an interface needs the energies of two sides");
    states.put({"surfa", id}, values[0]);
    states.put({"surfb", id}, values[1]);
    if (values.size() > 2) states.put({"frictional", id}, values.back());
  }
};

class Nodout : public AsciiReader {
  enum class Table { none, motion, rotation } table_ = Table::none;
  Real t_ = 0, cycle_ = 0;
  bool awaits_table_ = false;

 public:
  void line(std::string_view text, AsciiStates& states) override {
    if (has(text, "n o d a l   p r i n t")) {
      table_ = Table::none;
      t_ = time_behind(text, "at time", 14);
      cycle_ = number_behind(text, "s t e p", 8, "cycle");
      awaits_table_ = true;
      return;
    }
    if (has(text, "nodal point")) {
      awaits_table_ = false;
      table_ = has(text, "x-rot") ? Table::rotation : Table::motion;
      if (table_ == Table::rotation && states.begun() && states.time() == t_) return;
      states.begin(t_);
      return states.put({"cycle", {}}, cycle_);
    }
    if (table_ == Table::none || stripped(text).empty()) return;
    std::string_view rest = text;
    AsciiKey key{"", 0};
    if (!take_id(rest, *key.id)) {
      table_ = Table::none;  // whatever follows is no table any more
      return;
    }
    if (table_ == Table::motion)
      put_row(rest,
              {"x-disp", "y-disp", "z-disp", "x-vel", "y-vel", "z-vel", "x-accl", "y-accl", "z-accl",
               "x-coor", "y-coor", "z-coor"},
              12, key, states);
    else
      put_row(rest,
              {"x-rot", "y-rot", "z-rot", "x-rot vel", "y-rot vel", "z-rot vel", "x-rot acc", "y-rot acc",
               "z-rot acc"},
              12, key, states);
  }
  void end() override {
    if (awaits_table_) throw AsciiFault("the file is cut off: its last state has no table");
  }
};

class Rbdout : public AsciiReader {
  std::optional<std::int64_t> body_;
  bool local_ = false;

 public:
  void line(std::string_view text, AsciiStates& states) override {
    if (has(text, "r i g i d   b o d y   m o t i o n")) {
      body_.reset();
      states.begin(time_behind(text, "time=", 15));
      return states.put({"cycle", {}}, number_behind(text, "cycle=", 8, "cycle"));
    }
    if (has(text, "rigid body") && !has(text, ":")) {
      body_ = id_behind(text, "rigid body");
      local_ = false;
      return;
    }
    if (!body_) return;
    if (has(text, "output in principal")) local_ = true;
    const std::string_view row = stripped(text);
    for (const char* name : {"coordinates", "displacements", "velocities", "accelerations"}) {
      if (!row.starts_with(std::string(name) + ":")) continue;
      const std::string_view rest = behind(row, ":");
      if (local_)
        put_row(rest, {"a", "b", "c", "a-rot", "b-rot", "c-rot"}, 12,
                {std::string("local ") + name + " ", body_}, states);
      else if (std::string_view(name) == "coordinates")
        put_row(rest, {"x", "y", "z"}, 12, {"coordinates ", body_}, states);
      else
        put_row(rest, {"x", "y", "z", "x-rot", "y-rot", "z-rot"}, 12, {std::string(name) + " ", body_},
                states);
      return;
    }
    if (!row.starts_with("row")) return;
    const std::int64_t k = id_behind(row, "row");
    std::string_view rest = behind(row, "row");
    std::int64_t again = 0;
    take_id(rest, again);
    put_row(rest, {"a", "b", "c"}, 15, {"row " + std::to_string(k) + " ", body_}, states);
  }
};

class Bndout : public AsciiReader {
  std::string section_, side_;
  std::optional<std::int64_t> id_;

 public:
  void line(std::string_view text, AsciiStates& states) override {
    if (has(text, "n o d a l   f o r c e/e n e r g y")) {
      section_ = "nodal";
      const Real t = time_behind(text.substr(std::min(text.rfind("t="), text.size())), "t=", 9);
      return states.begin(t);
    }
    const std::string_view row = stripped(text);
    if (!has(row, "=")) {
      if (has(row, "forces"))
        section_ = std::string(row.substr(0, row.find(' ')));  // "velocity boundary ..."
      return;
    }
    if (!states.begun()) return;
    const bool node = row.starts_with("nd#"), body = row.starts_with("mat#");
    if (node || body) {
      std::string_view rest = behind(row, "#");
      std::int64_t id = 0;
      if (!take_id(rest, id)) throw AsciiFault("no id behind '#'");
      id_ = id;
      side_ = section_ + (node ? " nd#" : " mat#");
      return put_pairs(rest, id_, side_, states);
    }
    if (row.starts_with("xmoment")) return put_pairs(row, id_, side_, states);
    if (row.starts_with("xtotal")) return put_pairs(row, {}, section_, states);
  }
};

class Spcforc : public AsciiReader {
 public:
  void line(std::string_view text, AsciiStates& states) override {
    if (has(text, "output at time =")) return states.begin(time_behind(text, "output at time =", 14));
    const bool sum = has(text, "resultants"), node = has(text, "node=");
    if (!states.begun() || (!sum && !node)) return;
    if (sum) {
      const std::string name(stripped(text.substr(0, text.find('='))));
      return put_row(behind(text, "="), {"x", "y", "z"}, 14, {name + " ", {}}, states);
    }
    AsciiKey key{has(text, "moments") ? "moments " : "forces ", id_behind(text, "node=")};
    if (has(text, "setid=")) key.side = "setid " + std::to_string(id_behind(text, "setid="));
    const std::string_view rest = behind(text, "node=");
    if (!has(rest, "=")) throw AsciiFault("no forces on this line");
    put_row(behind(rest, "="), {"x", "y", "z"}, 14, key, states);
  }
};

class Rwforc : public AsciiReader {
 public:
  void line(std::string_view text, AsciiStates& states) override {
    if (has(text, "normal-force")) {
      rows_ = true, first_ = true;
      return;
    }
    std::string_view rest = text;
    if (!rows_ || stripped(text).empty()) return;
    Real time = 0;
    std::int64_t wall = 0;
    if (!take_number(rest, time, 12) || !std::isfinite(time))
      throw AsciiFault("no time at the begin of a row");
    if (!take_id(rest, wall)) throw AsciiFault("no wall behind the time");
    if (first_ || time != time_) states.begin(time);
    first_ = false, time_ = time;
    put_row(rest, {"normal", "x", "y", "z"}, 15, {"", wall}, states);
  }

 private:
  bool rows_ = false, first_ = true;
  Real time_ = 0;
};

class Sphout : public AsciiReader {
  std::vector<std::string> names_;

 public:
  void line(std::string_view text, AsciiStates& states) override {
    if (has(text, "S P H   o u t p u t")) {
      names_.clear();
      states.begin(time_behind(text, "at time", 11));
      if (has(text, "step")) states.put({"cycle", {}}, number_behind(text, "step", 10, "cycle"));
      return;
    }
    std::string_view row = stripped(text);
    if (row.starts_with("particle")) {
      names_.clear();
      for (; !row.empty(); row = stripped(row.substr(std::min(row.find(' '), row.size()))))
        names_.emplace_back(row.substr(0, row.find(' ')));
      if (names_.size() < 3 || names_[1] != "mat") throw AsciiFault("a head of columns that is not known");
      return;
    }
    if (names_.empty() || row.empty()) return;
    std::int64_t id = 0, part = 0;
    if (!take_id(row, id)) {
      names_.clear();
      return;
    }
    if (!take_id(row, part)) throw AsciiFault("no part behind the particle's id");
    const std::vector<Real> values = take_numbers(row, 12);
    const bool word = !stripped(row).empty();  // the state, "elastic"
    if (values.size() + (word ? 1 : 0) < names_.size() - 2)
      throw AsciiFault("the row has fewer columns than its head");
    for (std::size_t k = 0; k < std::min(values.size(), names_.size() - 2); ++k)
      states.put({names_[k + 2], id}, values[k]);
  }
};

template <class Reader>
std::unique_ptr<AsciiReader> make() {
  return std::make_unique<Reader>();
}

bool is_force_on_side(std::string_view line) {
  const std::string_view row = stripped(line);
  const bool side = row.starts_with("SURFA ") || row.starts_with("SURFB ") || row.starts_with("slave ") ||
                    row.starts_with("master ");
  return side && has(row, " time") && has(row, " x ");
}

}  // namespace

const std::vector<AsciiKind>& ascii_kinds() {
  using Line = std::string_view;
  static const std::vector<AsciiKind> kinds{
      {"glstat", [](Line line) { return line.starts_with(" dt of cycle"); }, make<Glstat>},
      {"matsum", [](Line line) { return line.starts_with(" mat.#="); }, make<Matsum>},
      {"rcforc", is_force_on_side, make<Rcforc>},
      {"sleout", [](Line line) { return has(line, "contact interface energy file"); }, make<Sleout>},
      {"nodout", [](Line line) { return has(line, "n o d a l   p r i n t   o u t"); }, make<Nodout>},
      {"rbdout", [](Line line) { return has(line, "r i g i d   b o d y   m o t i o n"); }, make<Rbdout>},
      {"bndout", [](Line line) { return has(line, "n o d a l   f o r c e/e n e r g y"); }, make<Bndout>},
      {"spcforc", [](Line line) { return has(line, "output at time ="); }, make<Spcforc>},
      {"rwforc", [](Line line) { return has(line, "wall#") && has(line, "normal-force"); }, make<Rwforc>},
      {"sphout", [](Line line) { return has(line, "S P H   o u t p u t"); }, make<Sphout>}};
  return kinds;
}

}  // namespace courant

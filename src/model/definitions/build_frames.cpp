// Local boxes, coordinate systems, vectors and tables.
#include <fmt/format.h>
#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

#include "base/rotation.hpp"
#include "keyword/source.hpp"
#include "model/definitions/define_cards.hpp"
#include "model/model_builder.hpp"

namespace courant {

namespace {

constexpr const char* no_plane = "the two directions are parallel or zero: they span no plane";

}  // namespace

void ModelBuilder::build_local_boxes() {
  for (const DefineBoxLocalCard& card : deck_.all<DefineBoxLocalCard>()) {
    Box box{.id = card.boxid,
            .low = {card.xmn, card.ymn, card.zmn},
            .high = {card.xmx, card.ymx, card.zmx},
            .local = true,
            .origin = {card.cx, card.cy, card.cz}};
    const char* high[] = {"XMX", "YMX", "ZMX"};
    for (int k = 0; k < 3; ++k)
      if (box.high[k] < box.low[k])
        error(
            card, high[k],
            fmt::format("expected a number not below the lowest, {:g}, got '{:g}'", box.low[k], box.high[k]));
    if (const auto axes = axes_from({card.xx, card.yx, card.zx}, {card.xv, card.yv, card.zv}))
      box.axes = *axes;
    else
      error(card, "XX", no_plane, "give the local x axis and another direction in the local xy plane");
    model_.boxes.emplace(card.boxid, box);
  }
}

namespace {

/// Whether *INCLUDE_TRANSFORM moves an entry as it does the system that the entry is given in: only then does
/// the entry go where its file goes.
bool moved_alike(const Deck& deck, const Entry& entry, Id cid) {
  const auto moved_by = [&](const Entry& e) -> const std::vector<Id>& {
    return deck.files[static_cast<std::size_t>(e.file)].conversion.transformations;
  };
  const auto holds = [&](const auto& cards) {
    for (const auto& card : cards)
      if (card.cid == cid && moved_by(card) != moved_by(entry)) return false;
    return true;
  };
  return holds(deck.all<CoordinateSystemCard>()) && holds(deck.all<CoordinateVectorCard>()) &&
         holds(deck.all<CoordinateNodesCard>());
}

std::string moved_otherwise(Id cid) {
  return fmt::format("system {} is in a file that *INCLUDE_TRANSFORM moves otherwise", cid);
}

}  // namespace

/// Systems may be given in others, in any order of the deck.
void ModelBuilder::build_coordinate_systems() {
  for (const CoordinateVectorCard& card : deck_.all<CoordinateVectorCard>()) {
    const auto axes = axes_from({card.xx, card.yx, card.zx}, {card.xv, card.yv, card.zv});
    if (!axes) error(card, "XX", no_plane);
    if (card.nid != 0) node(card, "NID", card.nid);
    model_.coordinate_systems[card.cid] = {.id = card.cid,
                                           .origin = Vec::Zero(),
                                           .axes = axes.value_or(Matrix::Identity()),
                                           .moves = card.nid != 0};
  }
  for (const CoordinateNodesCard& card : deck_.all<CoordinateNodesCard>()) add_system(card);
  std::map<Id, const CoordinateSystemCard*> open;
  for (const CoordinateSystemCard& card : deck_.all<CoordinateSystemCard>()) open.emplace(card.cid, &card);
  while (!open.empty()) {
    const std::size_t before = open.size();
    for (auto it = open.begin(); it != open.end();) {
      const CoordinateSystemCard& card = *it->second;
      const bool waits = card.cidl != 0 && open.count(card.cidl) != 0;
      if (!waits) add_system(card);
      it = waits ? std::next(it) : open.erase(it);
    }
    if (open.size() < before) continue;
    for (const auto& [cid, card] : open) {
      error(*card, "CIDL", fmt::format("system {} is given in itself, or in one that is given in it", cid));
      model_.coordinate_systems[cid] = {.id = cid};
    }
    return;
  }
}

void ModelBuilder::add_system(const CoordinateNodesCard& card) {
  CoordinateSystem& system = model_.coordinate_systems[card.cid];
  system.id = card.cid;
  system.moves = card.flag == 1;
  const Index n[] = {node(card, "N1", card.n1), node(card, "N2", card.n2), node(card, "N3", card.n3)};
  const std::string dir = upper_case(card.dir);
  const std::size_t first = dir.empty() ? 0 : std::string("XYZ").find(dir);
  if (dir.size() > 1 || first > 2) {
    error(card, "DIR", fmt::format("'{}' is not an axis", card.dir), "X, Y or Z");
    return;
  }
  if (*std::min_element(std::begin(n), std::end(n)) < 0) return;
  const auto x = [&](int k) -> const Vec& { return model_.nodes[static_cast<std::size_t>(n[k])].x; };
  system.origin = x(0);
  const auto axes = axes_from(x(1) - x(0), x(2) - x(0));
  if (!axes) {
    error(card, "N1", fmt::format("nodes {}, {} and {} are on one line", card.n1, card.n2, card.n3));
    return;
  }
  for (std::size_t k = 0; k < 3; ++k)  // the axis from N1 to N2 is DIR, the others follow in turn
    system.axes.col(static_cast<Eigen::Index>((first + k) % 3)) = axes->col(static_cast<Eigen::Index>(k));
}

void ModelBuilder::add_system(const CoordinateSystemCard& card) {
  CoordinateSystem system{.id = card.cid, .origin = {card.xo, card.yo, card.zo}};
  const Vec l(card.xl, card.yl, card.zl), p(card.xp, card.yp, card.zp);
  if (const auto axes = axes_from(l - system.origin, p - system.origin))
    system.axes = *axes;
  else
    error(card, "XL", fmt::format("the three points of system {} are on one line", card.cid));
  if (card.cidl != 0) {
    if (!moved_alike(deck_, card, card.cidl))
      error(card, "CIDL", moved_otherwise(card.cidl), "put both into one file");
    if (const CoordinateSystem* outer = coordinate_system(card, "CIDL", card.cidl)) {
      system.origin = outer->origin + outer->axes * system.origin;
      system.axes = outer->axes * system.axes;
      system.moves = outer->moves;
    }
  }
  model_.coordinate_systems[card.cid] = system;
}

void ModelBuilder::build_vectors() {
  for (const DefineVectorCard& card : deck_.all<DefineVectorCard>()) {
    ModelVector v{.id = card.vid, .tail = {card.xt, card.yt, card.zt}, .head = {card.xh, card.yh, card.zh}};
    if (v.tail == v.head)
      error(card, "XT", fmt::format("vector {} has no length: tail and head are one point", card.vid));
    if (card.cid != 0) {
      if (!moved_alike(deck_, card, card.cid))
        error(card, "CID", moved_otherwise(card.cid), "put both into one file");
      if (const CoordinateSystem* system = coordinate_system(card, "CID", card.cid)) {
        v.tail = system->origin + system->axes * v.tail;
        v.head = system->origin + system->axes * v.head;
        v.moves = system->moves;
      }
    }
    model_.vectors.emplace(card.vid, v);
  }
  for (const DefineVectorNodesCard& card : deck_.all<DefineVectorNodesCard>()) {
    const Index tail = node(card, "NODET", card.nodet), head = node(card, "NODEH", card.nodeh);
    if (tail < 0 || head < 0) continue;
    const ModelVector v{.id = card.vid,
                        .tail = model_.nodes[static_cast<std::size_t>(tail)].x,
                        .head = model_.nodes[static_cast<std::size_t>(head)].x,
                        .moves = true};
    if (v.tail == v.head)
      error(card, "NODEH",
            fmt::format("vector {} has no length: nodes {} and {} are at one position", card.vid, card.nodet,
                        card.nodeh));
    model_.vectors.emplace(card.vid, v);
  }
}

namespace {

std::vector<Real> scaled(const std::vector<Real>& values, Real scale, Real offset) {
  std::vector<Real> out;
  for (const Real v : values) out.push_back(scale * (v + offset));
  return out;
}

}  // namespace

void ModelBuilder::build_tables() {
  for (const DefineTableCard& card : deck_.all<DefineTableCard>()) {
    Table table{.id = card.tbid, .value = scaled(card.value, card.sfa, card.offa)};
    // entries are in the order of reading; the curves come behind the table in the same file
    const auto& curves = deck_.all<DefineCurveCard>();
    auto next = std::find_if(curves.begin(), curves.end(), [&](const DefineCurveCard& c) {
      return c.file == card.file && c.line > card.line;
    });
    Id last_line = std::numeric_limits<Id>::max();  // of what follows this table
    for (const DefineTableCard& other : deck_.all<DefineTableCard>())
      if (other.file == card.file && other.line > card.line) {
        last_line = other.line;
        break;
      }
    for (; table.curve.size() < table.value.size() && next != curves.end() && next->file == card.file &&
           next->line < last_line;
         ++next)
      table.curve.push_back(next->lcid);
    if (table.curve.size() < table.value.size())
      error(card, "VALUE",
            fmt::format("the table has {} values, but {} *DEFINE_CURVE follow", table.value.size(),
                        table.curve.size()),
            "put the curves behind the table, one for each value, or use *DEFINE_TABLE_2D");
    add_table(card, std::move(table));
  }
  const auto by_ids = [&](const DefineTable2dCard& card, bool of_tables) {
    Table table{.id = card.tbid,
                .value = scaled(card.value, card.sfa, card.offa),
                .curve = card.curveid,
                .of_tables = of_tables};
    add_table(card, std::move(table));
  };
  for (const DefineTable2dCard& card : deck_.all<DefineTable2dCard>()) by_ids(card, false);
  for (const DefineTable3dCard& card : deck_.all<DefineTable3dCard>()) by_ids(card, true);
  check_tables();
}

void ModelBuilder::add_table(const Entry& card, Table table) {
  if (table.value.empty()) error(card, "VALUE", "the table has no values");
  for (std::size_t i = 1; i < table.value.size(); ++i) {
    if (table.value[i] > table.value[i - 1]) continue;
    error(card, "VALUE",
          fmt::format("the values of table {} do not increase from row {} to row {}", table.id, i, i + 1));
    break;
  }
  model_.tables.emplace(table.id, std::move(table));
}

/// What a table names must be there: curves, or for _3D tables of curves.
void ModelBuilder::check_tables() {
  const auto check = [&](const DefineTable2dCard& card, bool of_tables) {
    const char* field = of_tables ? "TABLEID" : "CURVEID";
    for (const Id id : card.curveid) {
      const auto table = model_.tables.find(id);
      const bool found =
          of_tables ? table != model_.tables.end() && !table->second.of_tables : model_.curves.count(id) != 0;
      if (!found)
        error(card, field, fmt::format("{} {} does not exist", of_tables ? "table" : "curve", id),
              fmt::format("define it with {}", of_tables ? "*DEFINE_TABLE_2D" : "*DEFINE_CURVE"));
    }
  };
  for (const DefineTable2dCard& card : deck_.all<DefineTable2dCard>()) check(card, false);
  for (const DefineTable3dCard& card : deck_.all<DefineTable3dCard>()) check(card, true);
}

}  // namespace courant

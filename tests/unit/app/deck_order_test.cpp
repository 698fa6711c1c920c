// The bits of a run follow from what a deck says, not from the order in which it says it.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include "parallel/parallel.hpp"
#include "small_scene.hpp"
#include "time/step.hpp"

namespace courant {
namespace {

using test::SmallScene;
using test::steps;

struct DeckBlock {
  std::string keyword;
  std::vector<std::string> lines;
};

/// Whether each data line of the block is an entity of its own.
bool has_an_entity_per_line(const DeckBlock& block) {
  if (block.keyword == "*ELEMENT_SOLID") {
    constexpr std::size_t whole_line = 80;
    return std::all_of(block.lines.begin(), block.lines.end(), [](const std::string& line) {
      return line[0] == '$' || line.size() >= whole_line || std::count(line.begin(), line.end(), ',') >= 9;
    });
  }
  return block.keyword == "*NODE" || block.keyword == "*ELEMENT_SPH" || block.keyword == "*ELEMENT_SHELL" ||
         block.keyword == "*ELEMENT_BEAM";
}

/// The deck with the lines of its nodes and elements in another order, and blocks of nodes, elements and
/// parts exchanged.
std::string shuffled(const std::string& text, unsigned seed) {
  std::vector<DeckBlock> blocks(1);
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line[0] == '*')
      blocks.push_back({line, {}});
    else
      blocks.back().lines.push_back(line);
  }
  std::mt19937 random(seed);
  std::vector<std::size_t> movable, from;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const bool lines = has_an_entity_per_line(blocks[b]);
    if (lines) std::shuffle(blocks[b].lines.begin(), blocks[b].lines.end(), random);
    if (lines || blocks[b].keyword == "*PART") movable.push_back(b);
  }
  from = movable;
  std::shuffle(from.begin(), from.end(), random);
  std::vector<DeckBlock> out = blocks;
  for (std::size_t k = 0; k < movable.size(); ++k) out[movable[k]] = blocks[from[k]];
  std::string result;
  for (const DeckBlock& block : out) {
    if (!block.keyword.empty()) result += block.keyword + '\n';
    for (const std::string& line : block.lines) result += line + '\n';
  }
  return result;
}

using Numbers = std::map<std::string, std::map<Id, std::vector<Real>>>;

void add_fields(const FieldSet& set, const Field<Id>& id, Index count, Numbers& to) {
  for (const auto& field : set.all())
    if (const auto* reals = dynamic_cast<const Field<Real>*>(field.get()))
      for (Index i = 0; i < count; ++i)
        for (int k = 0; k < reals->info().components; ++k)
          to[set.name() + " " + reals->info().name][id[i]].push_back(reals->data(k)[i]);
}

/// All numbers of active particles, nodes and elements by id, and of the energy balance.
Numbers numbers_of(Simulation& s) {
  Numbers out;
  const World& w = s.world();
  add_fields(w.particles.fields, w.particles.id, w.particles.active, out);
  add_fields(w.nodes.fields, w.nodes.id, w.nodes.size(), out);
  for (const auto& group : w.groups) add_fields(group->fields, group->id, group->size(), out);
  sample_energy(s.world(), s.clock());
  const EnergyLedger& e = w.energy;
  out["energy"][0] = {e.kinetic,        e.internal,   e.potential,     e.contact,    e.hourglass,
                      e.bulk_viscosity, e.dissipated, e.external_work, e.throughput, e.half_step};
  out["clock"][0] = {s.clock().t, s.clock().dt};
  return out;
}

/// Of what the numbers differ, and how many entities do; "" where none does.
std::string difference(const Numbers& a, const Numbers& b) {
  std::string names;
  for (const auto& [name, values] : a) {
    const auto other = b.find(name);
    std::size_t count = 0;
    if (other != b.end())
      for (const auto& [id, numbers] : values) {
        const auto at = other->second.find(id);
        const bool same =
            at != other->second.end() &&
            std::equal(numbers.begin(), numbers.end(), at->second.begin(), at->second.end(),
                       [](Real x, Real y) { return x == y || (std::isnan(x) && std::isnan(y)); });
        count += same ? 0 : 1;
      }
    if (other == b.end() || count > 0 || values.size() != other->second.size())
      names += fmt::format(" {} ({} of {})", name, count, values.size());
  }
  return names;
}

void expect_no_trace_of_order(const std::string& deck, int many) {
  const auto as_written = test::build_deck(deck, false);
  ASSERT_TRUE(as_written);
  steps(*as_written, many);
  const Numbers expected = numbers_of(*as_written);
  const int before = threads();
  for (const unsigned seed : {1u, 2u}) {
    set_threads(static_cast<int>(seed));
    const std::string other = shuffled(deck, seed);
    EXPECT_NE(other, deck);
    const auto s = test::build_deck(other, false);
    ASSERT_TRUE(s);
    steps(*s, many);
    EXPECT_EQ(difference(expected, numbers_of(*s)), "") << "seed " << seed;
  }
  set_threads(before);
}

TEST(DeckOrder, LeavesNoTraceInWater) {
  const std::string floor = test::gravity_cards + test::floor_cards(),
                    mirror = "*BOUNDARY_SPH_SYMMETRY_PLANE\n0.,0.,0.,0.,1.,0.\n";
  const std::vector<std::pair<const char*, SmallScene>> scenes{
      {"2D", {.n = 14, .start = "0.5,-1.,0.", .extra = floor}},
      {"3D", {.dim = 3, .n = 6, .start = "0.5,-1.,0.", .extra = floor}},
      {"a body",
       {.dim = 3,
        .n = 4,
        .start = "0.,-2.,0.",
        .extra = test::gravity_cards + test::floor_cards(-0.025, 1, "1,5,7")}},
      {"evolving h", {.n = 10, .start = "0.,-3.,0.", .section = "1,1.2,0.5,2.", .extra = floor}},
      {"a box",
       {.n = 12,
        .start = "2.,0.,0.",
        .material = "1,1000.,-1.E20,0.5",
        .box = "1",
        .extra = "*DEFINE_BOX\n1,0.1,0.9,-1.,5.,-1.,1.\n"}},
      {"MAXV", {.n = 8, .start = "0.,-1.,0.", .control_sph = ",0,0,0,-1.2", .extra = floor}},
      {"bulk viscosity", {.n = 10, .start = "2.,0.,0.", .control_sph = ",0,0,0,1.E20,0,0,1", .extra = floor}},
      {"frozen gradients",
       {.start = "0.5,-0.5,0.",
        .eos = "*EOS_LINEAR_POLYNOMIAL\n1,0.,9.E7\n",
        .extra = floor + "*COURANT_PAIR_GEOMETRY\n0.05\n"}},
      {"volume control",
       {.n = 8, .start = "0.5,-0.5,0.", .extra = floor + "*COURANT_VOLUME_CONTROL\n0.01\n"}},
      {"level outlet",
       {.n = 8,
        .start = "0.5,0.,0.",
        .extra = floor + "*DEFINE_BOX\n7,0.3,1.,-0.1,1.,-1.,1.\n*COURANT_LEVEL_OUTLET\n7,0.4,0.05\n"}},
      {"Riemann", {.n = 8, .start = "0.5,-0.5,0.", .extra = floor + "*COURANT_RIEMANN\n3.\n"}},
      {"renormalised",
       {.n = 8, .start = "0.5,-1.,0.", .control_sph = ",0,1", .extra = test::gravity_cards + mirror}},
      {"shifting",
       {.n = 10,
        .start = "1.5,-0.5,0.",
        .control_sph = test::shifting_cards,
        .extra = floor + "*COURANT_SHIFTING\n2.,0.,0.,1\n*COURANT_XSPH\n0.5\n"}},
      {"periodic",
       {.n = 8,
        .start = "3.,-1.,0.",
        .extra =
            test::gravity_cards +
            ("*DEFINE_VECTOR\n1,0.,0.,0.,1.,0.,0.\n2,0.8,0.,0.,-1.,0.,0.\n*BOUNDARY_SPH_PERIODIC\n1,2\n" +
             mirror)}},
      {"an inlet",
       {.start = "0.5,0.,0.",
        .termination = "4.",
        .extra = "*NODE\n901,0.,0.05,0.\n902,0.,0.15,0.\n903,0.,0.25,0.\n*SET_NODE_LIST\n7\n901,902,903\n*"
                 "DEFINE_SPH_INJECTION\n1,7,0,2.\n"}},
      {"wall support",
       {.start = "0.5,-0.3,0.",
        .extra = test::gravity_cards + test::floor_cards(0) + "*COURANT_WALL_SUPPORT\n2,3,0.004\n"}}};
  for (const auto& [name, scene] : scenes) {
    SCOPED_TRACE(name);
    expect_no_trace_of_order(scene.text(), 90);
  }
}

TEST(DeckOrder, LeavesNoTraceInWholeDecks) {
  for (const auto& file : std::filesystem::directory_iterator(SOURCE_DIR "/tests/decks/accept")) {
    const std::string name = file.path().filename().string(), path = file.path().string();
    if (name.rfind("whole", 0) != 0 || file.path().extension() != ".k") continue;
    SCOPED_TRACE(name);
    Numbers numbers[2];
    for (const bool shuffle : {false, true}) {
      ReadOptions options;
      options.open = [&](const std::string& wanted) -> std::optional<std::string> {
        std::ifstream in(wanted, std::ios::binary);
        if (!in) return std::nullopt;
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        return shuffle && wanted == path ? shuffled(text, 5) : text;
      };
      Diagnostics diagnostics;
      const auto s = Simulation::build(path, options, diagnostics);
      ASSERT_TRUE(s) << diagnostics.text();
      steps(*s, 15);
      numbers[shuffle ? 1 : 0] = numbers_of(*s);
    }
    EXPECT_EQ(difference(numbers[0], numbers[1]), "");
  }
}

}  // namespace
}  // namespace courant

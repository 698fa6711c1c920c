// What field files hold: which particles, faces and elements, in which order, as which cells, how exactly;
// and which files of a run there are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "../text.hpp"
#include "output/fields/field_data.hpp"
#include "output/fields/vtk_arrays.hpp"
#include "output/fields/vtk_cell.hpp"
#include "output_test.hpp"
#include "state/shared_fields.hpp"

namespace courant::field_data_test {
namespace {

const VtkArray* find(const VtkDataSet& set, const std::string& name) {
  for (const VtkSection& section : set.sections)
    for (const VtkArray& array : section.arrays)
      if (array.name == name) return &array;
  return nullptr;
}
template <class T>
void append(const std::string& bytes, std::vector<Real>& out) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  out.insert(out.end(), values.begin(), values.end());
}
/// Values of whatever type.
std::vector<Real> values_of(const VtkArray& array) {
  const std::string type = array.type;
  std::vector<Real> out;
  if (type == "Float64") append<double>(array.bytes, out);
  if (type == "Float32") append<float>(array.bytes, out);
  if (type == "Int64") append<std::int64_t>(array.bytes, out);
  if (type == "Int32") append<std::int32_t>(array.bytes, out);
  if (type == "UInt8") append<std::uint8_t>(array.bytes, out);
  return out;
}
std::vector<Real> values_of(const VtkDataSet& set, const std::string& name) {
  const VtkArray* array = find(set, name);
  return array ? values_of(*array) : std::vector<Real>();
}
/// Nodes have ids, too.
std::vector<Real> element_ids(const VtkDataSet& set) {
  return values_of({.sections = {set.sections[1]}}, "id");
}
using Values = std::vector<Real>;

/// The small world, written in full precision, with parts 70 and 80.
struct Small {
  World world;
  FieldWriterOptions options{.part_ids = {70, 80}, .float64 = true};
  Small() { test::fill_small_world(world); }
  VtkDataSet particles() const { return particle_data(world.particles, all_of(3), 0, options); }
  VtkDataSet shells() const { return shell_data(world, options); }
};

ElementGroup& add_group(World& world, const char* name, Index part, int corners,
                        const std::vector<std::vector<Index>>& nodes) {
  FieldSet& set = world.add_set(name);
  set.resize(static_cast<Index>(nodes.size()));
  world.groups.push_back(std::make_unique<ElementGroup>(set, part, corners));
  ElementGroup& out = *world.groups.back();
  for (std::size_t e = 0; e < nodes.size(); ++e)
    for (std::size_t c = 0; c < nodes[e].size(); ++c)
      out.node.data(static_cast<int>(c))[static_cast<Index>(e)] = nodes[e][c];
  return out;
}

}  // namespace

// Each option of the request leaves out what it names and nothing else.
TEST(FieldData, OptionsChooseParticles) {
  Small s;  // ids 10, 20, 30 at x = 0.25, 0.5, 0; of parts 80, 70, 70; 20 is outside
  EXPECT_EQ(values_of(s.particles(), "id"), (Values{10, 20, 30}));
  EXPECT_EQ(values_of(s.particles(), "active"), (Values{1, 0, 1}));
  s.options.hide_inactive = true;
  EXPECT_EQ(values_of(s.particles(), "id"), (Values{10, 30}));
  s.options.hide_inactive = false, s.options.left_out = {0};
  EXPECT_EQ(values_of(s.particles(), "id"), Values{10});
  s.options.left_out = {}, s.options.inside = [](const Vec& x) { return x[0] > 0.1; };
  EXPECT_EQ(values_of(s.particles(), "id"), (Values{10, 20}));
  const VtkDataSet two = s.particles();
  EXPECT_EQ(two.sizes,
            "NumberOfPoints=\"2\" NumberOfVerts=\"2\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
            "NumberOfPolys=\"0\"");
  EXPECT_EQ(values_of(two, "connectivity"), (Values{0, 1}));
  EXPECT_EQ(values_of(two, "offsets"), (Values{1, 2}));
  EXPECT_EQ(values_of(two, "Points"), (Values{0.25, 0.5, 0, 0.5, 0.5, 0}));
}

TEST(FieldData, OptionsChooseArrays) {
  Small s;
  const auto names = [&] {
    std::vector<std::string> out;
    const VtkDataSet set = s.particles();
    for (const VtkArray& array : set.sections[0].arrays) out.push_back(array.name);
    return out;
  };
  s.options.fields = {"density", "part", "no such field"},
  s.options.extra = {"acceleration", "density", "nothing"};
  EXPECT_EQ(names(), (std::vector<std::string>{"density", "part", "acceleration"}));
  s.options.fields = {}, s.options.extra = {};
  const auto usual = names();
  EXPECT_TRUE(std::count(usual.begin(), usual.end(), "active") == 1 &&
              values_of(s.particles(), "acceleration").empty());
  const auto known = particle_array_names(s.world);
  EXPECT_TRUE(std::is_sorted(known.begin(), known.end()));
  for (const char* name : {"part", "active", "acceleration", "density", "density_rate"})
    EXPECT_EQ(std::count(known.begin(), known.end(), name), 1) << name;
  EXPECT_EQ(std::count(known.begin(), known.end(), "position"), 0);
}

// EPS is a part of the range of an array, EPSX one of the smallest h; values are off by so much at most, and
// by a good part of it, as they are rounded to powers of two.
TEST(FieldData, RoundingKeepsToItsBounds) {
  Small s;
  for (Index i = 0; i < 3; ++i) s.world.particles.rho[i] = 1000 + 100.0 / 3 * i;
  s.world.particles.x.set(1, Vec(0.1234567, 0.5, 0));
  s.options.eps = 0.01, s.options.epsx = 0.1;  // errors of 0.667 and 0.0006
  const Values rho = values_of(s.particles(), "density");
  Real worst = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Real exact[] = {1000 + 100.0 / 3, 1000 + 200.0 / 3, 1000};
    worst = std::max(worst, std::abs(rho[k] - exact[k]));
    EXPECT_EQ(rho[k], std::round(rho[k])) << "multiples of 1, the largest power of two below 2 x 0.667";
  }
  EXPECT_LE(worst, 0.01 * 200 / 3);
  EXPECT_GT(worst, 0.1);
  const Real x = values_of(s.particles(), "Points")[0],
             quantum = std::exp2(std::floor(std::log2(2 * 0.0006)));
  EXPECT_LE(std::abs(x - 0.1234567), 0.0006);
  EXPECT_EQ(std::remainder(x, quantum), 0);
  EXPECT_EQ(quantum_of(0.75), 1);
  EXPECT_EQ(quantum_of(1), 2);
  EXPECT_EQ(quantum_of(0), 0);
  EXPECT_EQ(quantum_of(std::numeric_limits<Real>::infinity()), 0);
  EXPECT_EQ(rounded(2.6, 0.5), 2.5);
  EXPECT_EQ(rounded(-2.8, 0.5), -3);
  EXPECT_EQ(rounded(0.3, 0), 0.3);
  EXPECT_FALSE(std::signbit(rounded(-0.1, 1)));
}

// Positions have 64 bits where 24 of them are off by a thousandth of h: beyond 0.006/1000 x 2^24 = 100.7.
TEST(FieldData, PositionsFarFromTheOriginAreExact) {
  for (const auto& [x, type] : {std::pair(90.0, "Float32"), {110.0, "Float64"}, {-110.0, "Float64"}}) {
    Small s;
    s.options.float64 = false;
    s.world.particles.x.set(2, Vec(0, x, 0));
    const VtkDataSet particles = s.particles();
    EXPECT_STREQ(find(particles, "Points")->type, type) << x;
    EXPECT_STREQ(find(particles, "density")->type, "Float32");
    Small t;
    t.options.float64 = false;
    t.world.nodes.x.set(4, Vec(0, x, 0));
    const VtkDataSet shells = t.shells();
    EXPECT_STREQ(find(shells, "Points")->type, type) << x;
    EXPECT_EQ(find(shells, "Points")->dimension, "");
  }
}

TEST(FieldData, CellsOfEachShape) {
  World world;
  world.nodes.fields.resize(12);
  struct Case {
    std::vector<Index> nodes;
    int type;
    std::vector<int> corners;
  };
  // VTK's numbers; a wedge of VTK has its first triangle seen from outside
  const Case cases[] = {{{0}, 1, {0}},
                        {{0, 1}, 3, {0, 1}},
                        {{0, 1, 2}, 5, {0, 1, 2}},
                        {{0, 1, 2, 3}, 10, {0, 1, 2, 3}},
                        {{0, 1, 2, 3, 4, 5, 6, 7}, 12, {0, 1, 2, 3, 4, 5, 6, 7}},
                        {{0, 1, 2, 3, 4, 4, 4, 4}, 14, {0, 1, 2, 3, 4}},
                        {{0, 1, 2, 2, 4, 4, 4, 4}, 10, {0, 1, 2, 4}},
                        {{0, 1, 2, 3, 4, 4, 6, 6}, 13, {0, 1, 4, 3, 2, 6}},
                        {{0, 1, 2, 2, 4, 5, 6, 6}, 13, {0, 2, 1, 4, 6, 5}},
                        {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, 24, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}};
  int number = 0;
  for (const Case& one : cases) {
    const ElementGroup& group = add_group(world, fmt::format("set {}", ++number).c_str(), 0,
                                          static_cast<int>(one.nodes.size()), {one.nodes});
    const VtkCell cell = vtk_cell(group, 0);
    EXPECT_EQ(int(cell.type), one.type) << number;
    EXPECT_EQ(std::vector<int>(cell.corners.begin(), cell.corners.end()), one.corners) << number;
  }
  ElementGroup& shell = add_group(world, "shell", 0, 4, {{0, 1, 2, 3}});
  shell.segment = &shell.fields.add<Index>({.name = "segment", .dimension = "-"});
  EXPECT_EQ(int(vtk_cell(shell, 0).type), 9);
}

// Nodes that no element uses are left out, and corners count among those that are there; a field that a group
// does not have, or has as another kind, is 0 there; elements without a part are of part 0.
TEST(FieldData, ElementsOfSeveralGroups) {
  World world;
  world.nodes.fields.resize(8);
  for (Index n = 0; n < 8; ++n) world.nodes.x.set(n, Vec(1.0 * n, 0, 0));
  Field<Real>& heat = world.nodes.fields.add<Real>({.name = "heat", .dimension = "-", .output = true});
  for (Index n = 0; n < 8; ++n) heat[n] = 0.5 * n;
  ElementGroup& tets = add_group(world, "tets", 1, 4, {{1, 3, 5, 7}, {3, 1, 7, 6}});
  ElementGroup& bars = add_group(world, "bars", -1, 2, {{6, 1}});
  ElementGroup& others = add_group(world, "others", 0, 2, {{0, 2}});
  Field<Real>& stress = tets.fields.add<Real>({.name = "damage", .dimension = "-", .output = true});
  stress[0] = 11, stress[1] = 12;
  Field<Real>& other = bars.fields.add<Real>({.name = "damage", .dimension = "L", .output = true});
  other[0] = 13;
  tets.id[0] = 101, tets.id[1] = 102, bars.id[0] = 103, others.id[0] = 104;
  FieldWriterOptions options{.part_ids = {70, 80}, .float64 = true};
  options.left_out = {0};
  VtkDataSet set = solid_data(world, options);
  EXPECT_EQ(set.sizes, "NumberOfPoints=\"5\" NumberOfCells=\"3\"");
  EXPECT_EQ(values_of(set, "heat"), (Values{0.5, 1.5, 2.5, 3, 3.5}));  // nodes 1, 3, 5, 6, 7
  EXPECT_EQ(values_of(set, "connectivity"), (Values{0, 1, 2, 4, 1, 0, 4, 3, 3, 0}));
  EXPECT_EQ(values_of(set, "offsets"), (Values{4, 8, 10}));
  EXPECT_EQ(values_of(set, "types"), (Values{10, 10, 3}));
  EXPECT_EQ(values_of(set, "damage"), (Values{11, 12, 0}));
  EXPECT_EQ(values_of(set, "part"), (Values{80, 80, 0}));
  EXPECT_EQ(element_ids(set), (Values{101, 102, 103}));
  EXPECT_EQ(values_of(set, "Points")[9], 6);
  options.left_out = {};
  shared_fields::eroded.add(tets.fields)[0] = shared_fields::deleted;
  set = solid_data(world, options);
  EXPECT_EQ(element_ids(set), (Values{102, 103, 104}));
  EXPECT_EQ(values_of(set, "damage"), (Values{12, 0, 0}));
  EXPECT_EQ(values_of(set, "offsets"), (Values{4, 6, 8}));
}

TEST(FieldData, OptionsChooseFaces) {
  Small s;
  EXPECT_EQ(values_of(s.shells(), "contact_force"), (Values{0, -5, 0, 0, -6, 0}));
  EXPECT_EQ(values_of(s.shells(), "connectivity"), (Values{0, 1, 2, 3, 0, 1, 2}));
  EXPECT_EQ(values_of(s.shells(), "types"), (Values{9, 5}));
  EXPECT_EQ(values_of(s.shells(), "Points").size(), 15u);
  s.options.sparse_shells = true;
  const VtkDataSet sparse = s.shells();
  EXPECT_EQ(find(sparse, "contact_force"), nullptr);
  EXPECT_NE(find(sparse, "id"), nullptr);
  s.options.left_out = {1};
  EXPECT_EQ(values_of(s.shells(), "types"), Values{});
}

namespace {

/// A folder with states of the small world, whose pressure is that of the state.
struct Written {
  test::ScratchFolder folder;
  Small small;
  void write(FieldWriter& writer, int begin, int end) {
    for (int state = begin; state < end; ++state) {
      small.world.particles.p[1] = state;
      writer.write(small.world, 0.1 * state, state);
    }
  }
  std::string text(const std::string& name) const { return test::read_text(folder / name); }
  bool has(const std::string& name) const { return std::filesystem::exists(folder / name); }
};

}  // namespace

// A state whose faces are those of before names the file from before, others a new one; forces do not count.
TEST(FieldData, FacesThatStayAreWrittenOnce) {
  Written w;
  w.small.options.sparse_shells = true;
  FieldWriter writer(w.folder.path(), w.small.options);
  w.write(writer, 0, 2);
  w.small.world.segments.contact_force->set(0, Vec(9, 9, 9));
  w.write(writer, 2, 3);
  w.small.world.nodes.x.set(0, Vec(0.1, 0, 0));
  w.write(writer, 3, 4);
  writer.finish();
  for (const auto& [name, there] : {std::pair("fields/shells_0000.vtu", true),
                                    {"fields/shells_0001.vtu", false},
                                    {"fields/shells_0002.vtu", false},
                                    {"fields/shells_0003.vtu", true}})
    EXPECT_EQ(w.has(name), there) << name;
  const std::string pvd = w.text("fields.pvd");
  EXPECT_EQ(test::count(pvd, "part=\"1\" name=\"shells\" file=\"fields/shells_0000.vtu\""), 3u);
  EXPECT_EQ(test::count(pvd, "part=\"0\" name=\"particles\""), 4u);
  EXPECT_EQ(writer.states(), 4);
  std::int64_t bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(w.folder / "fields"))
    bytes += static_cast<std::int64_t>(file.file_size());
  EXPECT_EQ(writer.bytes(), bytes);
}

// A run that goes on writes the bytes that one in one part writes, and files of later states are gone before.
TEST(FieldData, ARestartGoesOnWithTheSameBytes) {
  for (const bool sparse : {false, true}) {
    Written whole, parts;
    whole.small.options.sparse_shells = parts.small.options.sparse_shells = sparse;
    {
      FieldWriter writer(whole.folder.path(), whole.small.options);
      whole.write(writer, 0, 6), writer.finish();
    }
    SavedState saved;
    {
      FieldWriter writer(parts.folder.path(), parts.small.options);
      parts.write(writer, 0, 3);
      Archive archive = Archive::saver(saved);
      writer.keep(archive);
      parts.small.world.nodes.x.set(0, Vec(0.1, 0, 0));
      parts.write(writer, 3, 5), writer.finish();
      parts.small.world.nodes.x.set(0, Vec(0, 0, 0));
    }
    FieldWriter writer(parts.folder.path(), parts.small.options);
    Archive archive = Archive::loader(saved);
    writer.keep(archive), writer.cut(3);
    EXPECT_TRUE(parts.has("fields/particles_0002.vtp"));
    EXPECT_FALSE(parts.has("fields/particles_0003.vtp") || parts.has("fields/shells_0003.vtu"));
    EXPECT_EQ(test::count(parts.text("fields.pvd"), "particles_"), 3u);
    parts.write(writer, 3, 6), writer.finish();
    EXPECT_EQ(writer.states(), 6);
    for (const auto& file : std::filesystem::recursive_directory_iterator(whole.folder.path()))
      if (file.is_regular_file()) {
        const std::string name = std::filesystem::relative(file.path(), whole.folder.path()).string();
        EXPECT_EQ(parts.text(name), whole.text(name)) << name;
      }
  }
}

// Of a run that stopped in error: particles that have a position, halo among them, without rounding; no grids
// where a node has none. The list of states does not know of them.
TEST(FieldData, TheStateOfAFailure) {
  Written w;
  w.small.options.eps = 0.5, w.small.options.inside = [](const Vec&) { return false; };
  w.small.world.particles.active = 2;
  w.small.world.particles.x.set(0, Vec(std::nan(""), 0, 0));
  add_group(w.small.world, "bar", 0, 2, {{0, 1}});
  FieldWriter writer(w.folder.path(), w.small.options);
  writer.write_failed(w.small.world, 3);
  EXPECT_NE(w.text("fields/failed.vtp").find("NumberOfPoints=\"2\""), std::string::npos);
  EXPECT_TRUE(w.has("fields/failed_solids.vtu") && w.has("fields/failed_shells.vtu"));
  EXPECT_FALSE(w.has("fields.pvd"));
  EXPECT_EQ(writer.states(), 0);
  Written other;
  other.small.world.nodes.x.set(3, Vec(0, 1e39, 0));  // more than a float holds
  other.small.world.particles.moving = 0;
  FieldWriter(other.folder.path(), other.small.options).write_failed(other.small.world, 3);
  EXPECT_TRUE(std::filesystem::is_empty(other.folder / "fields"));
}

// Titles of parts are field data by the part's number; text is fit for XML.
TEST(FieldData, PartsHaveTheirTitles) {
  Written w;
  w.small.options.part_titles = {"", "a < b & \"c\" > d\t"};
  FieldWriter writer(w.folder.path(), w.small.options);
  const FieldState state = writer.take(w.small.world, 0.5, 3);
  EXPECT_EQ(state.number, 3);
  EXPECT_FALSE(state.solids.has_value());
  for (const auto* set : {&state.particles, &state.shells}) {
    EXPECT_EQ((*set)->t, 0.5);
    ASSERT_EQ((*set)->facts.size(), 1u);
    EXPECT_EQ((*set)->facts[0].name, "part 80: a &lt; b &amp; &quot;c&quot; &gt; d ");
    EXPECT_EQ(values_of((*set)->facts[0]), Values{80});
  }
}

}  // namespace courant::field_data_test

// What passes report, each number another one, and where it is found: texts of joints, welds, springs,
// elements and sections, field arrays, the summary. Sections against forces by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <stdexcept>

#include "elements/beam/weld.hpp"
#include "elements/discrete/discrete.hpp"
#include "elements/histories/elout_text.hpp"
#include "elements/histories/secforc.hpp"
#include "extension/additions.hpp"
#include "output/ascii/ascii.hpp"
#include "output/fields/field_data.hpp"
#include "output/fields/stress_invariants.hpp"
#include "output/fields/vtk_arrays.hpp"
#include "output/glstat.hpp"
#include "output_test.hpp"
#include "state/shared_fields.hpp"

namespace courant::reported_numbers_test {
namespace {

/// All numbers with an exponent, in their order.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> out;
  const auto is_in_number = [](char c) { return std::strchr("0123456789+-.E", c) != nullptr; };
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_in_number(text[end])) ++end;
    // columns may touch: a number is as wide as its exponent says
    while (at < end) {
      const std::size_t e = text.find('E', at);
      if (e == std::string::npos || e >= end || text.find('.', at) > e) break;
      const std::size_t last = e + 4;
      std::size_t first = text.find('.', at) - 1;
      if (first > at && text[first - 1] == '-') --first;
      out.push_back(std::stod(text.substr(first, last - first)));
      at = last;
    }
    at = std::max(at, end) + 1;
  }
  return out;
}
std::string text_of(const char* name, const World& world, const Clock& clock) {
  for (const AsciiHistory& one : ascii_histories())
    if (one.name == name) return one.text(world, clock);
  return "";
}
void expect_numbers(const std::string& text, const std::vector<Real>& expected) {
  const std::vector<double> found = numbers_in(text);
  ASSERT_EQ(found.size(), expected.size()) << text;
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k], expected[k], 1e-3 * std::abs(expected[k])) << k << text;
}

struct FakeReports : Pass, JointReporter, WeldReporter, SpringReporter {
  std::string name() const override { return "reported"; }
  void report_joints(std::vector<JointForce>& out) const override {
    out.push_back({.id = 3, .title = "", .force = {1.1, 2.2, 3.3}, .moment = {4.4, 5.5, 6.6}});
  }
  void report_welds(const World&, std::vector<WeldForce>& out) const override {
    out.push_back({.id = 4,
                   .axial = 1.1,
                   .shear = 2.2,
                   .moment = 3.3,
                   .torsion = 4.4,
                   .length = 5.5,
                   .failure_time = 6.6});
  }
  void report_springs(std::vector<SpringForce>& out) const override {
    out.push_back({5, false, {1.1, 2.2, 3.3}, 4.4, 5.5});
    out.push_back({6, true, {6.6, 7.7, 8.8}, 9.9, 1.2});
  }
  std::optional<SpringForce> find_spring(Id) const override { return std::nullopt; }
  const ElementGroup& spring_group() const override { throw std::logic_error("no group"); }
  SpringForce spring(Index) const override { return {}; }
};

}  // namespace

TEST(ReportedNumbers, OfJointsWeldsAndSprings) {
  World world;
  Clock clock;
  clock.t = 0.5;
  world.passes.add(std::make_shared<FakeReports>());
  const Real force = Vec(1.1, 2.2, 3.3).norm(), moment = Vec(4.4, 5.5, 6.6).norm();
  expect_numbers(text_of("jntforc", world, clock), {0.5, 1.1, 2.2, 3.3, 4.4, 5.5, 6.6, force, moment});
  expect_numbers(text_of("swforc", world, clock), {0.5, 1.1, 2.2, 6.6, 5.5, 3.3, 4.4});
  expect_numbers(text_of("deforc", world, clock), {0.5, 1.1, 2.2, 3.3, 4.4, 5.5, 6.6, 7.7, 8.8, 9.9, 1.2});
}

TEST(ReportedNumbers, OfElements) {
  Clock clock;
  clock.t = 0.5;
  EloutElement one{.id = 7, .part = 8, .material = 24};
  one.report.points.push_back(
      {.stress = {1.1, 2.2, 3.4, 4.4, 5.5, 6.6}, .plastic = 0.7, .history = {0.11, 0.12}});
  one.report.resultants = {1.2, 2.3, 3.4, 4.5, 5.6, 6.7};
  const auto& s = one.report.points[0].stress;
  const Real mises =
      std::sqrt(0.5 * (1.1 * 1.1 + 1.2 * 1.2 + 2.3 * 2.3) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
  const auto text = [&](ElementKind kind, int history) {
    return elout_text(kind, {one}, clock, {.local = false, .history = history});
  };
  const std::vector<Real> six(s.begin(), s.end());
  std::vector<Real> solid{0.5}, shell{0.5}, with_history{0.5};
  solid.insert(solid.end(), six.begin(), six.end()), shell = solid;
  solid.push_back(mises), solid.push_back(0.7), shell.push_back(0.7);
  with_history = solid;
  with_history.insert(with_history.end(), {0.5, 0.11, 0.12});
  expect_numbers(text(ElementKind::solid, 0), solid);
  expect_numbers(text(ElementKind::shell, 0), shell);
  for (const ElementKind kind : {ElementKind::solid, ElementKind::shell})
    expect_numbers(text(kind, 2), with_history);
  expect_numbers(text(ElementKind::beam, 0), {0.5, 1.2, 2.3, 3.4, 4.5, 5.6, 6.7, s[0], s[3], s[5], 0.7});
  EXPECT_NE(text(ElementKind::solid, 0).find("plastic"), std::string::npos);
  one.report.deleted = true;
  EXPECT_NE(text(ElementKind::solid, 0).find("failed"), std::string::npos);
}

namespace {

/// Two bricks 1 x 1 x 1 one beside the other along y, and a beam, with forces and moments on their corners.
struct Elements : ElementReporter {
  World& world;
  ElementGroup group;
  ElementKind of;
  Real measure;
  Elements(World& world, ElementKind kind, int corners, Real measure)
      : world(world),
        group(world.add_set(fmt::format("elements {}", static_cast<int>(kind))), 0, corners),
        of(kind),
        measure(measure) {
    group.keep_corner_moments();
  }
  ElementKind kind() const override { return of; }
  const ElementGroup& reported() const override { return group; }
  ElementReport report_element(const World&, Index, const ElementReportOptions&) const override { return {}; }
  Real cut_measure(Index) const override { return measure; }
  void fill() {
    for (int k = 0; k < 3 * group.corners(); ++k)
      for (Index e = 0; e < group.size(); ++e)
        group.corner_force->data(k)[e] = std::sin(1 + k + 3 * static_cast<Real>(e)),
        group.corner_moment->data(k)[e] = std::cos(2 + k + 5 * static_cast<Real>(e));
  }
};

struct Bricks {
  World world;
  std::unique_ptr<Elements> bricks, beam;
  std::vector<ReportedElement> all;
  Bricks() {
    world.nodes.fields.resize(14);
    for (Index n = 0; n < 12; ++n)
      world.nodes.x.set(n, Vec(n % 2, (n / 2) % 3, n / 6) + Vec(5, 7, 9)), world.nodes.m[n] = 1;
    world.nodes.x.set(12, Vec(5, 10, 9)), world.nodes.x.set(13, Vec(6, 10, 9.2));
    bricks = std::make_unique<Elements>(world, ElementKind::solid, 8, 1);
    beam = std::make_unique<Elements>(world, ElementKind::beam, 2, 0.3);
    bricks->group.fields.resize(2), beam->group.fields.resize(1);
    for (Index e = 0; e < 2; ++e) {
      const Index b = 2 * e;
      const Index corner[8] = {b, b + 1, b + 3, b + 2, b + 6, b + 7, b + 9, b + 8};
      for (int c = 0; c < 8; ++c) bricks->group.node.data(c)[e] = corner[c];
    }
    beam->group.node.data(0)[0] = 12, beam->group.node.data(1)[0] = 13;
    bricks->fill(), beam->fill();
    for (Index e = 0; e < 2; ++e) all.push_back({ElementKind::solid, bricks.get(), e});
    all.push_back({ElementKind::beam, beam.get(), 0});
  }
};

}  // namespace

// A plane at 0.25 of the shift through bricks and beam: force and moment of the corners behind it, about the
// centroid of the areas 1, 1 and 0.3; in axes of its own.
TEST(ReportedNumbers, OfSectionsAreSumsOverCornersBehindThePlane) {
  const Matrix axes = Eigen::AngleAxisd(0.7, Vec(1, 2, 3).normalized()).toRotationMatrix();
  Bricks b;
  CrossSection section(b.all, {.origin = Vec(5.25, 0, 0), .normal = Vec::UnitX()}, b.world);
  section.axes = axes;
  const SectionForce f = section.force(b.world);
  const Vec centroid = (Vec(5.25, 7.5, 9.5) + Vec(5.25, 8.5, 9.5) + 0.3 * Vec(5.25, 10, 9.05)) / 2.3;
  EXPECT_NEAR(f.area, 2.3, 1e-12);
  EXPECT_NEAR((f.centroid - centroid).norm(), 0, 1e-12);
  Vec force = Vec::Zero(), moment = Vec::Zero();
  for (const auto* one : {b.bricks.get(), b.beam.get()})
    for (Index e = 0; e < one->group.size(); ++e)
      for (int c = 0; c < one->group.corners(); ++c) {
        const Index n = one->group.node.data(c)[e];
        const Vec x = b.world.nodes.x.vec(n);
        if (x[0] > 5.25) continue;
        const auto at = [&](const Field<Real>& field) {
          return Vec(field.data(3 * c)[e], field.data(3 * c + 1)[e], field.data(3 * c + 2)[e]);
        };
        force += at(*one->group.corner_force);
        moment += (x - centroid).cross(at(*one->group.corner_force)) + at(*one->group.corner_moment);
      }
  EXPECT_NEAR((f.force - axes.transpose() * force).norm(), 0, 1e-12);
  EXPECT_NEAR((f.moment - axes.transpose() * moment).norm(), 0, 1e-12);
  // deleted elements are no part of it
  shared_fields::eroded.add(b.bricks->group.fields)[0] = 1;
  EXPECT_NEAR(section.force(b.world).area, 1.3, 1e-12);
  EXPECT_GT((section.force(b.world).force - f.force).norm(), 0.1);
}

// A disc and rectangles along an edge that is turned: only what lies on them whole.
TEST(ReportedNumbers, OfSectionsOfPiecesOfAPlane) {
  CuttingPlane plane{.origin = Vec(1, 2, 3), .normal = Vec::UnitZ(), .edge = Vec::UnitY()};
  const auto holds = [&](Real along, Real across, Real above = 0) {  // normal x edge = -x
    return plane.contains(Vec(1, 2, 3) + along * Vec::UnitY() - across * Vec::UnitX() + above * Vec::UnitZ(),
                          1e-9);
  };
  EXPECT_TRUE(holds(-5, 5));
  plane.length_l = 2;
  EXPECT_TRUE(holds(1.9, -7) && holds(0.1, 7));
  EXPECT_FALSE(holds(2.1, 0) || holds(-0.1, 0));
  plane.length_m = 0.5;
  EXPECT_TRUE(holds(1, 0.4));
  EXPECT_FALSE(holds(1, 0.6) || holds(1, -0.1) || holds(2.1, 0.4));
  plane.radius = 1;
  EXPECT_TRUE(holds(0.6, 0.7) && holds(-0.6, -0.7) && holds(0.9, 0, 4));
  EXPECT_FALSE(holds(0.8, 0.7));
}

// Of nodes that a set names, whatever elements: those that have one of them.
TEST(ReportedNumbers, OfSectionsOfSets) {
  Bricks b;
  const CrossSection section(b.all, std::vector<Index>{0, 6}, b.world);  // an edge of the first brick alone
  const SectionForce f = section.force(b.world);
  Vec force = Vec::Zero();
  for (const int c : {0, 4})
    force +=
        Vec(b.bricks->group.corner_force->data(3 * c)[0], b.bricks->group.corner_force->data(3 * c + 1)[0],
            b.bricks->group.corner_force->data(3 * c + 2)[0]);
  EXPECT_NEAR((f.force - force).norm(), 0, 1e-13);
  EXPECT_TRUE(CrossSection(b.all, std::vector<Index>{}, b.world).empty());
}

TEST(ReportedNumbers, OfSectionsAreInSecforc) {
  Bricks b;
  auto sections = std::make_shared<CrossSections>();
  sections->sections.emplace_back(b.all, CuttingPlane{.origin = Vec(5.25, 0, 0), .normal = Vec::UnitX()},
                                  b.world);
  b.world.passes.add(sections);
  const SectionForce f = sections->sections[0].force(b.world);
  Clock clock;
  clock.t = 0.5;
  std::vector<Real> expected{0.5};
  for (const auto& [v, last] :
       {std::pair(f.force, f.force.norm()), {f.moment, f.moment.norm()}, {f.centroid, f.area}}) {
    expected.insert(expected.end(), v.data(), v.data() + 3);
    expected.push_back(last);
  }
  expect_numbers(text_of("secforc", b.world, clock), expected);
}

// A tensor whose numbers are all different: principal values are its roots, the largest first.
TEST(ReportedNumbers, InvariantsOfStress) {
  const Real t[6] = {10, -4, 3, 2, 5, -1};
  std::vector<VtkArray> arrays;
  for (const char* name : {"stress", "stress_lower"})
    arrays.push_back(
        make_reals<6>(name, "M/LT2", 1, {true, 0}, [&](std::size_t, Real* to) { std::copy(t, t + 6, to); }));
  add_stress_invariants(arrays);
  std::map<std::string, std::vector<Real>> found;
  for (const VtkArray& array : arrays) {
    std::vector<Real> values(array.bytes.size() / sizeof(Real));
    std::memcpy(values.data(), array.bytes.data(), array.bytes.size());
    found[array.name] = values;
  }
  Matrix m;
  m << t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2];
  const Real p = -m.trace() / 3;
  const Matrix dev = m + p * Matrix::Identity();
  for (const char* suffix : {"", "_lower"}) {
    const std::string end = suffix;
    EXPECT_NEAR(found.at("pressure" + end)[0], p, 1e-12);
    EXPECT_NEAR(found.at("von_mises" + end)[0], std::sqrt(1.5 * dev.squaredNorm()), 1e-12);
    const auto& s = found.at("principal_stress" + end);
    EXPECT_GT(s[0], s[1]);
    EXPECT_GT(s[1], s[2]);
    for (const Real one : s) EXPECT_NEAR((m - one * Matrix::Identity()).determinant(), 0, 1e-9);
    EXPECT_NEAR(s[0] + s[1] + s[2], m.trace(), 1e-12);
  }
}

namespace {

std::vector<Real> reals_of(const VtkDataSet& set, const std::string& name) {
  for (const VtkSection& section : set.sections)
    for (const VtkArray& array : section.arrays)
      if (array.name == name) {
        std::vector<Real> out;
        const bool wide = std::string(array.type) == "Float64", id = std::string(array.type) == "Int64";
        const std::size_t width = wide || id ? 8 : 4;
        for (std::size_t at = 0; at < array.bytes.size(); at += width) {
          double d = 0;
          float f = 0;
          std::int64_t n = 0;
          std::int32_t small = 0;
          if (wide) std::memcpy(&d, array.bytes.data() + at, 8);
          if (id) std::memcpy(&n, array.bytes.data() + at, 8), d = static_cast<double>(n);
          if (std::string(array.type) == "Float32") std::memcpy(&f, array.bytes.data() + at, 4), d = f;
          if (std::string(array.type) == "Int32") std::memcpy(&small, array.bytes.data() + at, 4), d = small;
          out.push_back(d);
        }
        return out;
      }
  return {};
}

}  // namespace

// Fields of elements on the faces that are theirs, parts by their ids, without what is deleted; accelerations
// of particles f/m.
TEST(ReportedNumbers, OfFields) {
  World world;
  test::fill_small_world(world);
  world.particles.m[1] = 0.5;
  for (Index i = 0; i < 3; ++i) world.particles.f.set(i, Vec(1.0 * static_cast<Real>(i + 1), 2, 3));
  FieldWriterOptions options;
  options.part_ids = {70, 80}, options.float64 = true, options.fields = {"acceleration", "part"};
  world.particles.active = 2;
  const VtkDataSet particles = particle_data(world.particles, {0, 1, 2}, 0, options);
  // by id: 10 (index 1), 20 (index 2, not active), 30 (index 0)
  EXPECT_EQ(reals_of(particles, "acceleration"),
            (std::vector<Real>{2 / 0.5, 2 / 0.5, 3 / 0.5, 0, 0, 0, 1 / 0.025, 2 / 0.025, 3 / 0.025}));
  options.fields = {};
  world.part_ids = {70, 80};
  FieldSet& set = world.add_set("shells");
  set.resize(2);
  world.groups.push_back(std::make_unique<ElementGroup>(set, 1, 4));
  ElementGroup& group = *world.groups.back();
  group.segment = &set.add<Index>({.name = "segment", .dimension = "-"});
  (*group.segment)[0] = 1, (*group.segment)[1] = 0;
  Field<Real>& shown = set.add<Real>({.name = "shown", .dimension = "-", .output = true});
  shown[0] = 11, shown[1] = 12;
  const VtkDataSet shells = shell_data(world, options);
  EXPECT_EQ(reals_of(shells, "shown"), (std::vector<Real>{12, 11}));
  EXPECT_EQ(reals_of(shells, "part"), (std::vector<Real>{80, 80}));
  EXPECT_EQ(reals_of(shells, "offsets"), (std::vector<Real>{4, 7})) << "a quadrilateral and a triangle";
  Field<Index>& eroded = shared_fields::eroded.add(world.segments.fields);
  eroded[0] = shared_fields::deleted, eroded[1] = 0;
  EXPECT_EQ(reals_of(shell_data(world, options), "shown"), (std::vector<Real>{11}));

  World solids;
  Bricks b;
  FieldSet& of_bricks = b.bricks->group.fields;
  Field<Real>& also = of_bricks.add<Real>({.name = "shown", .dimension = "-", .output = true});
  also[0] = 21, also[1] = 22;
  b.world.groups.push_back(std::make_unique<ElementGroup>(of_bricks, 0, 8));
  EXPECT_EQ(reals_of(solid_data(b.world, options), "shown"), (std::vector<Real>{21, 22}));
  EXPECT_EQ(reals_of(solid_data(b.world, options), "part"), (std::vector<Real>{70, 70}));
  shared_fields::eroded.add(of_bricks)[0] = 1;
  EXPECT_EQ(reals_of(solid_data(b.world, options), "shown"), (std::vector<Real>{22}));
}

// Rows of a gauge that wait are in its file at the end.
TEST(ReportedNumbers, OfGaugesAreInTheirFileAtTheEnd) {
  test::ScratchFolder folder;
  HistoryRequests requests;
  requests.ask_gauge(0, {.name = "level", .columns = {{"h", "L", 1}}}, 0.1);
  {
    Histories histories(folder.path(), requests);
    Sample s;
    s.t = 0, s.dt = 0.1, s.gauges = {{0, {4.25}}};
    histories.write(s, true);
    histories.finish();
    EXPECT_NE(test::read_text(folder / "gauges/level.csv").find("4.25"), std::string::npos);
  }
}

}  // namespace courant::reported_numbers_test

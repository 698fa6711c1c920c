// Histories that joints, welds, springs and elements add: each number of binout and history.h5 under its
// name.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "elements/beam/weld.hpp"
#include "elements/discrete/discrete.hpp"
#include "elements/histories/elout_text.hpp"
#include "extension/additions.hpp"
#include "state/reports.hpp"

namespace courant::added_numbers_test {
namespace {

using Integers = std::vector<std::int64_t>;
using Reals = std::vector<Real>;

/// By "folder/name" and by path, with the dimension behind a blank.
struct Found {
  std::map<std::string, Reals> real;
  std::map<std::string, Integers> integer;
  std::map<std::string, std::string> text;
  std::map<std::string, Reals> value;
  explicit Found(const HistoryNumbers& numbers) {
    for (const HistoryFolder& folder : numbers.folders)
      for (const auto* arrays : {&folder.fixed, &folder.state})
        for (const HistoryArray& one : *arrays) {
          const std::string name = folder.name + (arrays == &folder.fixed ? ":" : "/") + one.name;
          if (const auto* reals = std::get_if<Reals>(&one.values))
            EXPECT_TRUE(real.emplace(name, *reals).second) << name;
          else if (const auto* integers = std::get_if<Integers>(&one.values))
            EXPECT_TRUE(integer.emplace(name, *integers).second) << name;
          else
            text[name] = std::get<std::string>(one.values);
        }
    for (const HistoryValue& one : numbers.values)
      EXPECT_TRUE(value.emplace(one.path + " " + one.dimension, one.components).second) << one.path;
  }
};
struct FakeReports : Pass, JointReporter, WeldReporter, SpringReporter {
  std::string name() const override { return "reported"; }
  void report_joints(std::vector<JointForce>& out) const override {
    out.push_back({.id = 3, .title = "hinge", .force = {1, 2, 2}, .moment = {4, 5, 20}});
  }
  void report_welds(const World&, std::vector<WeldForce>& out) const override {
    out.push_back(
        {.id = 4, .axial = 1, .shear = 2, .moment = 3, .torsion = 4, .length = 5, .failure_time = 6});
    out.push_back({.id = 8, .axial = 11, .shear = 12, .moment = 13, .torsion = 14, .length = 15});
  }
  void report_springs(std::vector<SpringForce>& out) const override {
    out.push_back({5, false, {1, 2, 3}, 4, 5});
    out.push_back({6, true, {7, 8, 9}, 10, 11});
  }
  std::optional<SpringForce> find_spring(Id) const override { return std::nullopt; }
  const ElementGroup& spring_group() const override { throw std::logic_error("no group"); }
  SpringForce spring(Index) const override { return {}; }
};
Found added(const char* name) {
  World world;
  Clock clock;
  world.passes.add(std::make_shared<FakeReports>());
  HistoryNumbers numbers;
  for (const AsciiHistory& one : ascii_histories())
    if (one.name == name) one.numbers(world, clock, numbers);
  return Found(numbers);
}
/// Two elements of two points each, all of whose numbers differ.
std::vector<EloutElement> two_elements() {
  std::vector<EloutElement> out;
  for (int e = 0; e < 2; ++e) {
    EloutElement one{.id = 7 + e, .part = 20 + e, .material = 24 + e};
    for (std::size_t k = 0; k < 6; ++k) one.report.resultants[k] = 100.0 * e + 50 + static_cast<Real>(k);
    for (int p = 0; p < 2; ++p) {
      PointReport point;
      for (std::size_t k = 0; k < 6; ++k)
        point.stress[k] = 1000.0 * e + 200 * p + static_cast<Real>(k),
        point.strain[k] = -(1000.0 * e + 200 * p + 10 + static_cast<Real>(k));
      point.plastic = e == 0 && p == 0 ? 0 : 0.1 + p;
      point.history = {3000.0 + 100 * e + 10 * p, 3001.0 + 100 * e + 10 * p};
      one.report.points.push_back(point);
    }
    out.push_back(one);
  }
  out[1].report.deleted = true;
  return out;
}
Found elout(ElementKind kind, const EloutContent& content) {
  HistoryNumbers numbers;
  add_elout_numbers(kind, two_elements(), content, numbers);
  return Found(numbers);
}
/// Of all points of `two_elements`, in their order.
template <class Of>
Reals of_points(const Of& of) {
  Reals out;
  for (const EloutElement& e : two_elements())
    for (const PointReport& p : e.report.points) out.push_back(of(p));
  return out;
}
constexpr const char* axes[] = {"xx", "yy", "zz", "xy", "yz", "zx"};

}  // namespace

TEST(AddedNumbers, OfJoints) {
  const Found f = added("jntforc");
  EXPECT_EQ(f.integer.at("joints:ids"), Integers{3});
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(f.real.at(std::string("joints/") + "xyz"[k] + "_force"), (Reals{Vec(1, 2, 2)[k]}));
    EXPECT_EQ(f.real.at(std::string("joints/") + "xyz"[k] + "_moment"), (Reals{Vec(4, 5, 20)[k]}));
  }
  EXPECT_EQ(f.real.at("joints/resultant_force"), Reals{3});
  EXPECT_EQ(f.real.at("joints/resultant_moment"), Reals{21});
  EXPECT_EQ(f.value.at("/joints/3/force ML/T2"), (Reals{1, 2, 2}));
  EXPECT_EQ(f.value.at("/joints/3/moment ML2/T2"), (Reals{4, 5, 20}));
}

TEST(AddedNumbers, OfWelds) {
  const Found f = added("swforc");
  EXPECT_EQ(f.integer.at(":ids"), (Integers{4, 8}));
  EXPECT_EQ(f.integer.at(":types"), (Integers{2, 2}));
  EXPECT_EQ(f.integer.at("/failure_flag"), (Integers{1, 0}));
  const std::map<std::string, Reals> expected{
      {"axial", {1, 11}},  {"shear", {2, 12}},  {"resultant_moment", {3, 13}}, {"torsion", {4, 14}},
      {"length", {5, 15}}, {"failure", {1, 0}}, {"failure_time", {6, 0}}};
  for (const auto& [name, values] : expected) EXPECT_EQ(f.real.at("/" + name), values) << name;
  EXPECT_EQ(f.value.at("/welds/8/axial ML/T2"), Reals{11});
  EXPECT_EQ(f.value.at("/welds/8/shear ML/T2"), Reals{12});
  EXPECT_EQ(f.value.at("/welds/8/resultant_moment ML2/T2"), Reals{13});
  EXPECT_EQ(f.value.at("/welds/8/torsion ML2/T2"), Reals{14});
  EXPECT_EQ(f.value.at("/welds/8/length L"), Reals{15});
  EXPECT_EQ(f.value.at("/welds/4/failure_time T"), Reals{6});
}

TEST(AddedNumbers, OfSprings) {
  const Found f = added("deforc");
  EXPECT_EQ(f.integer.at(":ids"), (Integers{5, 6}));
  EXPECT_EQ(f.integer.at(":irot"), (Integers{0, 1}));
  EXPECT_EQ(f.real.at("/x_force"), (Reals{1, 7}));
  EXPECT_EQ(f.real.at("/y_force"), (Reals{2, 8}));
  EXPECT_EQ(f.real.at("/z_force"), (Reals{3, 9}));
  EXPECT_EQ(f.real.at("/resultant_force"), (Reals{4, 10}));
  EXPECT_EQ(f.real.at("/displacement"), (Reals{5, 11}));
  EXPECT_EQ(f.value.at("/springs/5/force ML/T2"), (Reals{1, 2, 3}));
  EXPECT_EQ(f.value.at("/springs/5/resultant ML/T2"), Reals{4});
  EXPECT_EQ(f.value.at("/springs/5/change_in_length L"), Reals{5});
  EXPECT_EQ(f.value.at("/springs/6/moment ML2/T2"), (Reals{7, 8, 9}));
  EXPECT_EQ(f.value.at("/springs/6/resultant ML2/T2"), Reals{10});
  EXPECT_EQ(f.value.at("/springs/6/relative_rotation -"), Reals{11});
  EXPECT_EQ(f.value.size(), 6u);
}

TEST(AddedNumbers, OfSolidsAndShells) {
  for (const ElementKind kind : {ElementKind::solid, ElementKind::shell})
    for (const bool strains : {false, true})
      for (const int history : {0, 2}) {
        const bool shell = kind == ElementKind::shell;
        const std::string of = shell ? "shell" : "solid", group = "/" + of + "s/";
        const Found f = elout(kind, {.local = true, .history = history, .strains = strains});
        EXPECT_EQ(f.integer.at(of + ":ids"), (Integers{7, 8}));
        EXPECT_EQ(f.integer.at(of + "/ids"), (Integers{7, 8}));
        EXPECT_EQ(f.integer.at(of + (shell ? "/mat" : "/mtype")), (Integers{20, 21}));
        EXPECT_EQ(f.integer.at(of + "/nip"), (Integers{2, 2}));
        EXPECT_EQ(f.integer.contains(of + "/iop"), shell);
        EXPECT_EQ(f.integer.at(of + "/state"), (Integers{1, 2, 3, 3}));
        EXPECT_EQ(f.text.at(of + ":states"), "elastic,plastic,failed");
        EXPECT_EQ(f.text.at(of + ":system"), shell ? "local " : "global") << "solids know no axes of theirs";
        for (std::size_t k = 0; k < 6; ++k)
          EXPECT_EQ(f.real.at(fmt::format("{}/sig_{}", of, axes[k])),
                    of_points([k](const PointReport& p) { return p.stress[k]; }));
        EXPECT_EQ(f.real.at(of + (shell ? "/plastic_strain" : "/yield")),
                  of_points([](const PointReport& p) { return p.plastic; }));
        EXPECT_EQ(f.real.contains(of + "/effsg"), !shell);
        if (!shell) EXPECT_NEAR(f.real.at("solid/effsg")[0], std::sqrt(0.5 * (1 + 1 + 4) + 3 * 50), 1e-12);
        for (int h = 0; h < 3; ++h) {
          const std::string name = fmt::format("history_{}", h + 1);
          ASSERT_EQ(f.real.contains(of + "/" + name), h < history) << h;
          EXPECT_EQ(f.value.contains(group + "7/" + name + "_of_point_2 -"), h < history) << h;
          if (h < history) {
            EXPECT_EQ(f.real.at(of + "/" + name), of_points([h](const PointReport& p) {
                        return p.history[static_cast<std::size_t>(h)];
                      }));
            EXPECT_EQ(f.value.at(group + "8/" + name + "_of_point_2 -"), Reals{3110.0 + h});
          }
        }
        const auto elements = two_elements();
        for (std::size_t k = 0; k < 6; ++k) {
          EXPECT_EQ(f.real.contains(std::string("solid/eps_") + axes[k]), strains && !shell);
          EXPECT_EQ(f.real.contains(std::string("shell/lower_eps_") + axes[k]), strains && shell);
          if (strains && !shell)
            EXPECT_EQ(f.real.at(std::string("solid/eps_") + axes[k]),
                      of_points([k](const PointReport& p) { return p.strain[k]; }));
          for (const bool upper : {false, true})
            if (strains && shell)
              EXPECT_EQ(f.real.at(fmt::format("shell/{}_eps_{}", upper ? "upper" : "lower", axes[k])),
                        (Reals{elements[0].report.points[upper ? 1 : 0].strain[k],
                               elements[1].report.points[upper ? 1 : 0].strain[k]}));
        }
        const auto six = [](const std::array<Real, 6>& of) { return Reals(of.begin(), of.end()); };
        for (std::size_t e = 0; e < 2; ++e) {
          const std::string path = group + std::to_string(7 + e) + "/";
          EXPECT_EQ(f.value.at(path + "deleted -"), Reals{Real(e)});
          for (std::size_t p = 0; p < 2; ++p) {
            const PointReport& point = elements[e].report.points[p];
            const std::string name = fmt::format("_of_point_{}", p + 1);
            EXPECT_EQ(f.value.at(path + "stress" + name + " M/LT2"), six(point.stress));
            EXPECT_EQ(f.value.at(path + "plastic_strain" + name + " -"), Reals{point.plastic});
            EXPECT_EQ(f.value.contains(path + "strain" + name + " -"), strains && !shell);
            if (strains && !shell) EXPECT_EQ(f.value.at(path + "strain" + name + " -"), six(point.strain));
            const std::string side = path + (p == 0 ? "strain_lower -" : "strain_upper -");
            EXPECT_EQ(f.value.contains(side), strains && shell);
            if (strains && shell) EXPECT_EQ(f.value.at(side), six(point.strain));
          }
        }
      }
}

TEST(AddedNumbers, OfBeams) {
  const Found f = elout(ElementKind::beam, {.local = true, .history = 1, .strains = true});
  EXPECT_EQ(f.integer.at("beam/ids"), (Integers{7, 8}));
  EXPECT_EQ(f.integer.at("beam/mat"), (Integers{20, 21}));
  EXPECT_EQ(f.integer.at("beam/mtype"), (Integers{24, 25}));
  EXPECT_EQ(f.integer.at("beam/nip"), (Integers{2, 2}));
  EXPECT_FALSE(f.text.contains("beam:states"));
  constexpr const char* names[] = {"axial", "shear_s", "shear_t", "moment_s", "moment_t", "torsion"};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(f.real.at(std::string("beam/") + names[k]), (Reals{50.0 + Real(k), 150.0 + Real(k)}));
    EXPECT_EQ(f.value.at(fmt::format("/beams/8/{} {}", names[k], k < 3 ? "ML/T2" : "ML2/T2")),
              Reals{150.0 + Real(k)});
  }
  const std::pair<const char*, std::size_t> stresses[] = {{"sigma_11", 0}, {"sigma_12", 3}, {"sigma_31", 5}};
  for (const auto& [name, k] : stresses)
    EXPECT_EQ(f.real.at(std::string("beam/") + name),
              of_points([k = k](const PointReport& p) { return p.stress[k]; }));
  EXPECT_EQ(f.real.at("beam/plastic_eps"), of_points([](const PointReport& p) { return p.plastic; }));
  EXPECT_EQ(f.real.at("beam/history_1"), of_points([](const PointReport& p) { return p.history[0]; }));
  EXPECT_EQ(f.value.at("/beams/8/beam_stress_of_point_2 M/LT2"), (Reals{1200, 1203, 1205}));
  EXPECT_EQ(f.value.at("/beams/8/plastic_strain_of_point_2 -"), Reals{1.1});
  EXPECT_FALSE(f.value.contains("/beams/8/strain_of_point_2 -"));
}

// One point has no number in its name; without points there are resultants alone.
TEST(AddedNumbers, OfOnePointAndOfNone) {
  auto elements = two_elements();
  elements.pop_back(), elements[0].report.points.pop_back();
  HistoryNumbers one, none;
  add_elout_numbers(ElementKind::solid, elements, {.strains = true}, one);
  const Found f(one);
  EXPECT_TRUE(f.value.contains("/solids/7/stress M/LT2"));
  EXPECT_TRUE(f.value.contains("/solids/7/strain -"));
  EXPECT_EQ(f.real.at("solid/sig_xy"), Reals{3});
  elements[0].report.points.clear();
  add_elout_numbers(ElementKind::beam, elements, {}, none);
  const Found g(none);
  EXPECT_EQ(g.integer.at("beam/nip"), Integers{0});
  EXPECT_EQ(g.real.at("beam/torsion"), Reals{55});
  EXPECT_FALSE(g.real.contains("beam/sigma_11"));
}

// Strains follow stresses: of all points of solids, of the outer ones of shells.
TEST(AddedNumbers, StrainsInElout) {
  Clock clock;
  const auto text = [&](ElementKind kind, bool strains, bool local = false) {
    return elout_text(kind, two_elements(), clock, {.local = local, .strains = strains});
  };
  const auto line = [](Real first) {
    std::string out;
    for (int k = 0; k < 6; ++k) out += fmt::format("{:12.4E}", first - k);
    return out;
  };
  const std::string solids = text(ElementKind::solid, true), shells = text(ElementKind::shell, true);
  EXPECT_EQ(solids.find(text(ElementKind::solid, false)), 0u);
  for (const std::string& point : {"       1 elastic " + line(-10), "       2 plastic " + line(-210),
                                   "       1 failed  " + line(-1010), "       2 failed  " + line(-1210)})
    EXPECT_NE(solids.find(point), std::string::npos) << point;
  EXPECT_EQ(shells.find(text(ElementKind::shell, false)), 0u);
  for (const std::string& side :
       {"       7-     20\n lower surface   " + line(-10) + "\n upper surface   " + line(-210),
        "       8-     21\n lower surface   " + line(-1010) + "\n upper surface   " + line(-1210)})
    EXPECT_NE(shells.find(side), std::string::npos) << side;
  EXPECT_NE(shells.find("(global)"), std::string::npos);
  EXPECT_NE(text(ElementKind::shell, true, true).find(" strains (local)"), std::string::npos);
  EXPECT_EQ(text(ElementKind::beam, true), text(ElementKind::beam, false));
}

}  // namespace courant::added_numbers_test

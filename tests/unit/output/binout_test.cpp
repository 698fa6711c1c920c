// binout as its readers see it: each number of a sample in the array of its name, and nothing besides.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "../text.hpp"
#include "full_sample.hpp"
#include "output/ascii/ascii.hpp"
#include "output/glstat.hpp"
#include "output_test.hpp"

namespace courant::binout_test {
namespace {

using Numbers = std::map<std::string, std::vector<Real>>;

/// What a file in LSDA holds, by the tables that name it: numbers of reals and integers, and texts.
struct Lsda {
  Numbers numbers{};
  std::map<std::string, std::string> texts{};
  int tables = 0;

  explicit Lsda(const std::filesystem::path& file) : bytes_(test::read_text(file)) {
    EXPECT_EQ(bytes_.substr(0, 8), std::string("\10\10\10\1\1\1\0\0", 8));
    EXPECT_EQ(command(8), 7);  // where the first table is
    for (std::size_t at = word(17); at != 0; ++tables) at = read_table(at);
  }

 private:
  std::size_t word(std::size_t at) const {
    std::uint64_t out = 0;
    if (at + 8 > bytes_.size()) throw std::out_of_range("behind the end of the file");
    std::memcpy(&out, bytes_.data() + at, 8);
    return out;
  }
  int command(std::size_t at) const { return bytes_.at(at + 8); }

  /// Returns where the next table is, 0: none.
  std::size_t read_table(std::size_t at) {
    EXPECT_EQ(command(at), 5);
    const std::size_t end = at + word(at);
    std::string folder;
    for (at += 9; command(at) != 6; at += word(at)) {
      const std::string content = bytes_.substr(at + 9, word(at) - 9);
      if (command(at) == 2)
        folder = content;
      else
        read_variable(folder, content);
    }
    EXPECT_EQ(at + word(at), end) << "the length of a table";
    return word(at + 9);
  }
  void read_variable(const std::string& folder, const std::string& entry) {
    const std::string name = entry.substr(0, entry.size() - 17);
    const int type = entry[name.size()];
    std::uint64_t at = 0, count = 0;
    std::memcpy(&at, entry.data() + name.size() + 1, 8);
    std::memcpy(&count, entry.data() + name.size() + 9, 8);
    EXPECT_EQ(command(at), 3) << name;
    EXPECT_EQ(bytes_[at + 9], type) << name;
    EXPECT_EQ(bytes_.substr(at + 11, static_cast<std::size_t>(bytes_[at + 10])), name);
    const std::string values = bytes_.substr(at + 11 + name.size(), word(at) - 11 - name.size());
    EXPECT_EQ(values.size(), count * (type == 1 ? 1 : 8)) << name;
    const std::string path = folder + "/" + name;
    EXPECT_FALSE(numbers.contains(path) || texts.contains(path)) << path << " is there twice";
    if (type == 1) {
      texts[path] = values;
      return;
    }
    for (std::size_t k = 0; k < count; ++k) {
      Real real = 0;
      std::int64_t whole = 0;
      std::memcpy(&real, values.data() + 8 * k, 8), std::memcpy(&whole, values.data() + 8 * k, 8);
      numbers[path].push_back(type == 10 ? real : static_cast<Real>(whole));
    }
  }

  std::string bytes_;
};

/// Arrays of one state of a history, by name.
struct State {
  Numbers of{};
  void add(const std::string& name, std::vector<Real> values) { of[name] = std::move(values); }
  void add(const std::string& form, const std::vector<Vec>& values) {
    for (int k = 0; k < 3; ++k) {
      std::string name = form;
      name.replace(name.find("{}"), 2, 1, "xyz"[k]);
      for (const Vec& one : values) of[name].push_back(one[k]);
    }
  }
  template <class List, class Member>
  void add(const std::string& name, const List& list, Member member) {
    std::vector<std::decay_t<decltype(std::invoke(member, list.front()))>> values;
    for (const auto& one : list) values.push_back(std::invoke(member, one));
    add(name, values);
  }
};

State glstat_of(const Sample& s, Real first) {
  const GlstatNumbers g = glstat_numbers(s, first);
  State out;
  for (const auto& [name, value] : {std::pair("time_step", s.dt),
                                    {"kinetic_energy", g.kinetic},
                                    {"internal_energy", g.internal},
                                    {"hourglass_energy", g.hourglass},
                                    {"stonewall_energy", g.stonewall},
                                    {"rigid_body_stopper_energy", 0},
                                    {"spring_and_damper_energy", g.discrete},
                                    {"system_damping_energy", 0},
                                    {"sliding_interface_energy", g.sliding},
                                    {"external_work", g.external_work},
                                    {"eroded_kinetic_energy", 0},
                                    {"eroded_internal_energy", g.eroded_internal},
                                    {"eroded_hourglass_energy", g.eroded_hourglass},
                                    {"total_energy", g.total},
                                    {"energy_ratio", g.ratio},
                                    {"energy_ratio_wo_eroded", g.ratio_without_eroded},
                                    {"global_x_velocity", s.velocity[0]},
                                    {"global_y_velocity", s.velocity[1]},
                                    {"global_z_velocity", s.velocity[2]},
                                    {"added_mass", g.added_mass}})
    out.add(name, std::vector<Real>{value});
  return out;
}
State matsum_of(const Sample& s) {
  using P = PartSample;
  State out;
  out.add("internal_energy", s.parts, &P::internal), out.add("kinetic_energy", s.parts, &P::kinetic);
  out.add("eroded_internal_energy", s.parts, &P::eroded_internal);
  out.add("eroded_kinetic_energy", std::vector<Real>{0, 0});
  out.add("eroded_hourglass_energy", s.parts, &P::eroded_hourglass);
  out.add("hourglass_energy", s.parts, &P::hourglass), out.add("mass", s.parts, &P::mass);
  out.add("added_mass", s.parts, &P::added_mass), out.add("{}_momentum", s.parts, &P::momentum);
  out.add("{}_rbvelocity", s.parts, &P::rigid_velocity);
  return out;
}
State rcforc_of(const Sample& s) {
  const Vec a = s.interfaces[0].on_surfa, b = s.interfaces[1].on_surfa;
  State out;
  out.add("{}_force", std::vector<Vec>{a, -a, b, -b}), out.add("mass", std::vector<Real>(4, 0));
  return out;
}
State sleout_of(const Sample& s) {
  std::vector<Real> all, friction;
  for (const InterfaceForce& i : s.interfaces)
    all.push_back(i.energy_stored + i.energy_damping + i.energy_friction),
        friction.push_back(i.energy_friction);
  State out;
  out.add("slave", all), out.add("master", std::vector<Real>{0, 0}), out.add("friction_energy", friction);
  out.add("total_slave", std::vector<Real>{all[0] + all[1]});
  out.add("total_energy", std::vector<Real>{all[0] + all[1]});
  out.add("total_master", std::vector<Real>{0});
  out.add("total_friction", std::vector<Real>{friction[0] + friction[1]});
  return out;
}
State nodout_of(const Sample& s) {
  using N = NodeSample;
  State out;
  out.add("{}_displacement", s.nodes, &N::displacement), out.add("{}_velocity", s.nodes, &N::v);
  out.add("{}_acceleration", s.nodes, &N::a), out.add("{}_coordinate", s.nodes, &N::x);
  out.add("r{}_displacement", s.nodes, &N::rotation), out.add("r{}_velocity", s.nodes, &N::omega);
  out.add("r{}_acceleration", s.nodes, &N::angular_a);
  return out;
}
State rbdout_of(const Sample& s) {
  using M = RigidBodyMotion;
  const auto& all = s.body_motions;
  State out;
  out.add("global_{}", all, &M::x), out.add("global_d{}", all, &M::displacement);
  out.add("global_rd{}", all, &M::rotation), out.add("global_v{}", all, &M::v);
  out.add("global_rv{}", all, &M::omega), out.add("global_a{}", all, &M::a);
  out.add("global_ra{}", all, &M::angular_a);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out.add(fmt::format("dircos_{}{}", i + 1, j + 1), std::vector<Real>{all[0].axes(i, j)});
  return out;
}
State sphout_of(const Sample& s) {
  const ParticleSample& p = s.particles[0];
  State out;
  for (const auto& [name, k] : {std::pair("sig_xx", 0u),
                                {"sig_yy", 1u},
                                {"sig_zz", 2u},
                                {"sig_xy", 3u},
                                {"sig_yz", 4u},
                                {"sig_zx", 5u}})
    out.add(name, std::vector<Real>{p.tau[k] - (k < 3 ? p.p : 0)});
  out.add("density", std::vector<Real>{p.rho}), out.add("smooth", std::vector<Real>{p.h});
  out.add("neigh", std::vector<Real>{static_cast<Real>(p.neighbours)});
  out.add("act", std::vector<Real>{p.active ? 1.0 : 0.0});
  return out;
}
/// Arrays of all states, by path.
Numbers expected_state(const Sample& s, Real first, int number) {
  using Kind = BoundaryForce::Kind;
  using W = RigidWallForce;
  const auto of_kind = [&](Kind kind) { return s.boundary_forces[static_cast<std::size_t>(kind)]; };
  const BoundaryForce point = of_kind(Kind::driven_point), body = of_kind(Kind::driven_body),
                      held = of_kind(Kind::held_point), turn = of_kind(Kind::held_rotation);
  State walls, nodes, bodies, supports;
  walls.add("normal_force", s.rigid_walls, &W::normal), walls.add("{}_force", s.rigid_walls, &W::force);
  for (const auto& [to, one, moment] : {std::tuple(&nodes, point, false), {&bodies, body, true}}) {
    to->add("ids", std::vector<Real>{static_cast<Real>(one.id)});
    to->add("{}_force", std::vector<Vec>{one.force}), to->add("{}_total", std::vector<Vec>{one.force});
    to->add("energy", std::vector<Real>{one.work}), to->add("e_total", std::vector<Real>{one.work});
    if (moment) to->add("{}_moment", std::vector<Vec>{one.moment});
  }
  supports.add("ids", std::vector<Real>{static_cast<Real>(held.id)});
  supports.add("{}_force", std::vector<Vec>{held.force}),
      supports.add("{}_resultant", std::vector<Vec>{held.force});
  supports.add("{}_moment", std::vector<Vec>{turn.moment});
  Numbers out;
  for (const auto& [folder, state] : {std::pair<std::string, State>("/glstat", glstat_of(s, first)),
                                      {"/matsum", matsum_of(s)},
                                      {"/rcforc", rcforc_of(s)},
                                      {"/sleout", sleout_of(s)},
                                      {"/nodout", nodout_of(s)},
                                      {"/rbdout", rbdout_of(s)},
                                      {"/sphout", sphout_of(s)},
                                      {"/rwforc/forces", walls},
                                      {"/bndout/velocity/nodes", nodes},
                                      {"/bndout/velocity/rigidbodies", bodies},
                                      {"/spcforc", supports}}) {
    const std::string in = fmt::format("{}/d{:06d}/", folder, number);
    for (const auto& [name, values] : state.of) out[in + name] = values;
    out[in + "time"] = {s.t}, out[in + "cycle"] = {static_cast<Real>(s.cycle)};
  }
  return out;
}
const Numbers expected_metadata = {{"/matsum/metadata/ids", {5, 6}},
                                   {"/matsum/metadata/legend_ids", {5}},
                                   {"/rcforc/metadata/ids", {5, 5, 6, 6}},
                                   {"/rcforc/metadata/side", {0, 1, 0, 1}},
                                   {"/rcforc/metadata/legend_ids", {6}},
                                   {"/sleout/metadata/ids", {5, 6}},
                                   {"/sleout/metadata/single_sided", {0, 0}},
                                   {"/nodout/metadata/ids", {3}},
                                   {"/nodout/metadata/legend_ids", {3}},
                                   {"/rbdout/metadata/ids", {7}},
                                   {"/sphout/metadata/ids", {17}},
                                   {"/rwforc/forces/metadata/ids", {5, 6}},
                                   {"/rwforc/forces/metadata/legend_ids", {5}},
                                   {"/bndout/velocity/nodes/metadata/ids", {30}},
                                   {"/bndout/velocity/rigidbodies/metadata/ids", {31}},
                                   {"/spcforc/metadata/ids", {32}},
                                   {"/spcforc/metadata/force_ids", {32}},
                                   {"/spcforc/metadata/moment_ids", {34}}};

const char* const all_histories[] = {"glstat", "matsum", "rcforc", "sleout", "nodout",
                                     "rbdout", "sphout", "rwforc", "bndout", "spcforc"};
HistoryRequests requests(int binary) {
  HistoryRequests out{.title = "a scene"};
  out.titles = {.parts = {{5, "water"}},
                .contacts = {{6, "floor"}},
                .nodes = {{3, "tip"}},
                .rigid_walls = {{5, "wall"}}};
  for (const char* name : all_histories) out.ask(name, 1.0, binary);
  return out;
}
/// Another sample a second later.
Sample sample_at(int second) {
  Sample s = test::sample_of_all();
  s.t = second, s.dt = 0.5, s.cycle = 40 + second;
  s.energy.kinetic += second, s.parts[1].mass += second, s.interfaces[0].on_surfa *= 1 + second;
  s.particles[0].neighbours = 12 + second;
  return s;
}
void expect_same(const Numbers& found, const Numbers& expected) {
  for (const auto& [path, values] : expected) {
    const auto at = found.find(path);
    if (at == found.end()) {
      ADD_FAILURE() << path << " is missing";
      continue;
    }
    ASSERT_EQ(at->second.size(), values.size()) << path;
    // sums may be added up in another order
    for (std::size_t k = 0; k < values.size(); ++k)
      EXPECT_NEAR(at->second[k], values[k], 1e-13 * std::abs(values[k])) << path << " " << k;
  }
  for (const auto& [path, values] : found) EXPECT_TRUE(expected.contains(path)) << path;
}
Numbers all_of_states(std::vector<std::pair<Sample, Real>> samples) {
  Numbers out = expected_metadata;
  int number = 0;
  for (const auto& [s, first] : samples) out.merge(expected_state(s, first, ++number));
  return out;
}

}  // namespace

TEST(Binout, HoldsEachNumberOfEachState) {
  for (const int binary : {2, 3}) {
    test::ScratchFolder folder;
    const Real first = sample_at(0).energy.potential;
    Histories histories(folder.path(), requests(binary));
    for (const int second : {0, 1}) histories.write(sample_at(second));
    histories.finish();
    const Lsda file(folder / "binout0000");
    expect_same(file.numbers, all_of_states({{sample_at(0), first}, {sample_at(1), first}}));
    EXPECT_EQ(file.texts.at("/glstat/metadata/title"), "a scene" + std::string(73, ' '));
    EXPECT_EQ(file.texts.at("/glstat/metadata/version"), "courant   ");
    EXPECT_EQ(file.texts.at("/glstat/metadata/date").size(), 10u);
    EXPECT_EQ(file.texts.at("/matsum/metadata/legend"), "water" + std::string(65, ' '));
    EXPECT_EQ(file.texts.at("/rwforc/forces/metadata/legend"), "wall" + std::string(66, ' '));
    for (const char* name : all_histories)
      EXPECT_EQ(std::filesystem::exists(folder / name), binary == 3) << name << " as text, too";
  }
}

// Of a run that goes on from its second state the third follows it, as if it had never stopped; what
// the earlier run had written after that is gone. The first potential energy is that of the first run.
TEST(Binout, GoesOnAfterARestart) {
  test::ScratchFolder folder;
  const Real first = sample_at(0).energy.potential;
  HistoryPositions then;
  {
    Histories histories(folder.path(), requests(3));
    for (const int second : {0, 1}) histories.write(sample_at(second));
    histories.finish();
    then = histories.positions();
    for (const int second : {2, 3}) histories.write(sample_at(second));
    histories.finish();
    EXPECT_GT(histories.positions().binout_bytes, then.binout_bytes);
  }
  Sample other = sample_at(2);
  other.energy.potential += 3, other.mass += 2;
  {
    Histories histories(folder.path(), requests(3), &then);
    EXPECT_TRUE(histories.lost().empty());
    histories.write(other);
    histories.finish();
  }
  const Lsda file(folder / "binout0000");
  expect_same(file.numbers, all_of_states({{sample_at(0), first}, {sample_at(1), first}, {other, first}}));
  EXPECT_EQ(file.tables, 3 * 10) << "one of each history and state";
  EXPECT_EQ(test::count(test::read_text(folder / "glstat"), "dt of cycle"), 3u);
  EXPECT_EQ(test::count(test::read_text(folder / "matsum"), "BEGIN LEGEND"), 1u);
  std::filesystem::resize_file(folder / "binout0000", static_cast<std::uintmax_t>(then.binout_bytes) - 5);
  std::filesystem::resize_file(folder / "matsum", static_cast<std::uintmax_t>(then.bytes.at("matsum")) - 5);
  Histories histories(folder.path(), requests(3), &then);
  ASSERT_EQ(histories.lost().size(), 2u) << "binout and matsum have lost their ends";
  histories.write(other);
  histories.finish();
  expect_same(Lsda(folder / "binout0000").numbers, all_of_states({{other, first}}));
}

// A folder whose first entity comes later has its `metadata` then, and once.
TEST(Binout, FoldersMayBeginLater) {
  test::ScratchFolder folder;
  HistoryRequests wanted{.title = "late"};
  wanted.ask("bndout", 1.0, 2);
  Histories histories(folder.path(), wanted);
  Sample none;
  none.dt = 0.5;
  histories.write(none);
  for (const int second : {1, 2}) histories.write(sample_at(second));
  const Lsda file(folder / "binout0000");
  EXPECT_EQ(file.numbers.at("/bndout/velocity/nodes/metadata/ids"), std::vector<Real>{30});
  EXPECT_EQ(file.numbers.at("/bndout/velocity/nodes/d000003/time"), std::vector<Real>{2});
  EXPECT_FALSE(file.numbers.contains("/bndout/velocity/nodes/d000001/time"));
}

}  // namespace courant::binout_test

// ASCII histories read back: those of our writers, and pieces in the layouts of LS-DYNA, written by hand.
#include "post/ascii_history.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../output/output_test.hpp"
#include "output/ascii.hpp"
#include "output/file.hpp"
#include "post/ascii_reader.hpp"

namespace courant {
namespace {

using test::ScratchFolder;

/// A file that is read; faults are kept.
class Read {
 public:
  explicit Read(const std::string& text) {
    write_file(folder_ / "file", text);
    file_ = AsciiFile::open(folder_ / "file", diagnostics_);
  }
  bool whole() const { return file_.has_value(); }
  const AsciiFile& operator*() const { return *file_; }
  const AsciiFile* operator->() const { return &*file_; }
  /// Messages, the folder's name left out.
  std::string faults() const {
    std::string text = diagnostics_.text();
    for (std::size_t at; (at = text.find(folder_.path().string())) != std::string::npos;)
      text.erase(at, folder_.path().string().size() + 1);
    return text;
  }
  std::vector<Real> column(const AsciiKey& key) const {
    std::string why, hint;
    const AsciiColumn* found = file_ ? file_->find(key, why, hint) : nullptr;
    if (!found) ADD_FAILURE() << key.name << ": " << why << " " << hint << faults();
    return found ? found->values : std::vector<Real>(8, std::nan(""));
  }
  Real last(const AsciiKey& key) const { return column(key).back(); }
  std::string unit(const AsciiKey& key) const {
    std::string why, hint;
    const AsciiColumn* found = file_ ? file_->find(key, why, hint) : nullptr;
    return found ? file_->dimension(*found) : why;
  }
  std::string why(const AsciiKey& key) const {
    std::string text, hint;
    return file_->find(key, text, hint) ? "" : text + "; " + hint;
  }

 private:
  ScratchFolder folder_;
  Diagnostics diagnostics_;
  std::optional<AsciiFile> file_;
};

/// Every number another one; `k` tells states apart.
Sample sample(int k) {
  Sample s;
  s.t = 0.25 * k + 1e-7;
  s.dt = 2.5e-6;
  s.cycle = 8000 + k;
  s.dt_set_by = "sph particle 17 of part 1";
  s.energy = {.kinetic = 100.0 + k,
              .internal = 20,
              .potential = 7,
              .contact = 3,
              .dissipated = 5,
              .external_work = 25,
              .initial = 110};
  s.velocity = Vec(1.5, -2.5e-101, 0);
  const auto part = [&](Id id, Real a) {
    PartSample p;
    p.id = id, p.internal = a, p.kinetic = 2 * a, p.momentum = Vec(3 * a, -4 * a, 5 * a),
    p.rigid_velocity = Vec(6 * a, 7 * a, 8 * a);
    return p;
  };
  s.parts = {part(1, 1.25 + k), part(50000, -2.5 - k)};
  for (const Id id : {Id(4), Id(12)}) {
    InterfaceForce contact;
    contact.id = id;
    contact.on_surfa = Vec(1.0 * static_cast<Real>(id), -196.2 * k, 1e-120);
    contact.energy_stored = 1, contact.energy_damping = 2,
    contact.energy_friction = 0.5 * static_cast<Real>(id) + k;
    s.interfaces.push_back(contact);
  }
  ParticleSample particle;
  particle.id = 17, particle.part = 1, particle.p = 1234.5 * (k + 1), particle.rho = 998 + k,
  particle.h = 0.0125;
  particle.tau = {1, 2, -3, 4, 5, 6}, particle.neighbours = 21 + k, particle.active = k > 0;
  s.particles = {particle};
  NodeSample plain, turning;
  plain.id = 101, plain.displacement = Vec(1, 2, 3 + k), plain.v = Vec(-4, -5e-110, -6),
  plain.a = Vec(7, 8, 9), plain.x = Vec(10, 11, 12);
  turning = plain;
  turning.id = 90000001, turning.turns = true, turning.rotation = Vec(0.1, 0.2, 0.3 * k),
  turning.omega = Vec(0.4, 0.5, 0.6), turning.angular_a = Vec(0.7, 0.8, 0.9);
  s.nodes = {plain, turning};
  RigidBodyMotion body;
  body.part = 5, body.x = Vec(1, 2, 3), body.displacement = Vec(4, 5, 6 * k),
  body.rotation = Vec(0.1, 0.2, 0.3);
  body.v = Vec(7, 8, 9), body.omega = Vec(0.4, 0.5, 0.6), body.a = Vec(-1, -2, -3),
  body.angular_a = Vec(-4, -5, -6);
  body.axes << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  s.body_motions = {body};
  const auto force = [&](BoundaryForce::Kind kind, Id id, Real a) {
    BoundaryForce b;
    b.kind = kind, b.id = id, b.force = Vec(a, 2 * a, 3 * a * k), b.moment = Vec(4 * a, 5 * a, 6 * a),
    b.work = 7 * a;
    return b;
  };
  s.boundary_forces = {force(BoundaryForce::Kind::driven_point, 30, 1.5),
                       force(BoundaryForce::Kind::driven_body, 30, -2.5),
                       force(BoundaryForce::Kind::held_point, 20, 3.5)};
  s.rigid_walls = {{.id = 7, .normal = 12.5 * k, .force = Vec(0, -12.5 * k, 0), .dissipated = 3.5 * k},
                   {.id = 8, .normal = 0.5}};
  return s;
}

/// Head and three states, as a run writes them.
std::string file(std::string (*text)(const Sample&), bool legend = false) {
  std::string out = ascii_header("a title", "11/22/2025");
  if (legend) out += ascii_legend({{1, "water"}, {50000, "time = 3 mat.#= nodal point x-disp"}});
  for (int k = 0; k < 3; ++k) out += text(sample(k));
  return out;
}

void expect_printed(Real is, Real ought, int digits) {
  EXPECT_NEAR(is, ought, std::abs(ought) * 0.5001 * std::pow(10.0, 1 - digits));
}

TEST(AsciiFile, GlstatOfOurs) {
  const Read glstat(file([](const Sample& s) { return glstat_text(s, 4); }));
  ASSERT_TRUE(glstat.whole()) << glstat.faults();
  EXPECT_EQ(glstat->kind(), "glstat");
  ASSERT_EQ(glstat->times().size(), 3u);
  expect_printed(glstat->times()[2], 0.5000001, 6);
  EXPECT_EQ(glstat.column({"kinetic energy", {}}), (std::vector<Real>{100, 101, 102}));
  EXPECT_EQ(glstat.last({"cycle", {}}), 8002);
  EXPECT_EQ(glstat.last({"external work", {}}), 22);
  EXPECT_EQ(glstat.last({"total energy / initial energy", {}}),
            glstat.last({"energy ratio w/o eroded energy", {}}));
  EXPECT_EQ(glstat.last({"global y velocity", {}}), -2.5e-101);
  EXPECT_EQ(glstat.last({"time per zone cycle.(nanosec)", {}}), 0);
  EXPECT_EQ(glstat.unit({"kinetic energy", {}}), "ML2/T2");
  EXPECT_EQ(glstat.unit({"total energy / initial energy", {}}), "-");
  EXPECT_EQ(glstat.unit({"global x velocity", {}}), "L/T");
  EXPECT_EQ(glstat->columns().size(), 21u);
}

TEST(AsciiFile, MatsumOfOurs) {
  const Read matsum(file(matsum_text, true));
  EXPECT_EQ(matsum.column({"inten", 1}), (std::vector<Real>{1.25, 2.25, 3.25}));
  EXPECT_EQ(matsum.last({"kinen", 50000}), -9);
  EXPECT_EQ(matsum.last({"z-mom", 1}), 5 * 3.25);
  EXPECT_EQ(matsum.last({"y-rbv", 1}), 7 * 3.25);
  EXPECT_EQ(matsum.last({"+mass", 1}), 0);
  EXPECT_EQ(matsum->columns().size(), 2 * 13u);
  EXPECT_EQ(matsum.why({"inten", {}}), "matsum has several 'inten'; tell id, or side: 1, 50000");
  EXPECT_EQ(matsum.why({"inten", 7}), "matsum has no 'inten' of 7; it has that of 1, 50000");
  EXPECT_EQ(matsum.why({"x_mom", 1}), "matsum has no 'x_mom'; did you mean 'x-mom'?");
}

TEST(AsciiFile, ContactsOfOurs) {
  const Read rcforc(file(rcforc_text, true));
  EXPECT_EQ(rcforc->times().size(), 3u);
  EXPECT_EQ(rcforc.column({"y", 4, "SURFA"}), (std::vector<Real>{0, -196.2, -392.4}));
  EXPECT_EQ(rcforc.last({"y", 12, "master"}), 392.4);
  EXPECT_EQ(rcforc.last({"z", 12, "SURFB"}), -1e-120);
  EXPECT_EQ(rcforc.unit({"x", 4, "SURFB"}), "ML/T2");
  EXPECT_EQ(rcforc.why({"x", 4}), "rcforc has several 'x' of 4; tell id, or side: 4 SURFA, 4 SURFB");
  const Read sleout(file(sleout_text));
  EXPECT_EQ(sleout.column({"frictional", 12}), (std::vector<Real>{6, 7, 8}));
  EXPECT_EQ(sleout.last({"surfa", 4}), 7);
  EXPECT_EQ(sleout.last({"surfb", 4}), 0);
  EXPECT_EQ(sleout.last({"total energy", {}}), 7 + 11);
  EXPECT_EQ(sleout.last({"total friction", {}}), 12);
}

TEST(AsciiFile, NodesAndBodiesOfOurs) {
  const Read nodout(file(nodout_text, true));
  EXPECT_EQ(nodout->times().size(), 3u);
  EXPECT_EQ(nodout.column({"z-disp", 90000001}), (std::vector<Real>{3, 4, 5}));
  EXPECT_EQ(nodout.last({"y-vel", 101}), -5e-110);
  EXPECT_EQ(nodout.last({"x-accl", 101}), 7);
  EXPECT_EQ(nodout.last({"z-coor", 101}), 12);
  EXPECT_EQ(nodout.last({"z-rot", 90000001}), 0.6);
  EXPECT_EQ(nodout.last({"x-rot vel", 90000001}), 0.4);
  EXPECT_EQ(nodout.last({"z-rot acc", 90000001}), 0.9);
  EXPECT_EQ(nodout.unit({"y-accl", 101}), "L/T2");
  EXPECT_EQ(nodout.unit({"y-rot acc", 101}), "1/T2");
  const Read rbdout(file(rbdout_text));
  EXPECT_EQ(rbdout.column({"displacements z", 5}), (std::vector<Real>{0, 6, 12}));
  EXPECT_EQ(rbdout.last({"coordinates y", 5}), 2);
  EXPECT_EQ(rbdout.last({"velocities z-rot", 5}), 0.6);
  EXPECT_EQ(rbdout.last({"accelerations x", 5}), -1);
  EXPECT_EQ(rbdout.last({"row 2 a", 5}), -1);
  EXPECT_EQ(rbdout.last({"local velocities a", 5}), -8);  // axes^T v
  EXPECT_EQ(rbdout.last({"local velocities b", 5}), 7);
  EXPECT_EQ(rbdout.unit({"displacements x-rot", 5}), "-");
  EXPECT_EQ(rbdout.unit({"velocities x", 5}), "L/T");
}

TEST(AsciiFile, BoundariesAndParticlesOfOurs) {
  const Read bndout(file(bndout_text));
  EXPECT_EQ(bndout.column({"zforce", 30, "nd#"}), (std::vector<Real>{0, 4.5, 9}));
  EXPECT_EQ(bndout.last({"energy", 30, "velocity mat#"}), -17.5);
  EXPECT_EQ(bndout.last({"ymoment", 30}), -12.5);
  EXPECT_EQ(bndout.last({"xtotal", {}}), -1);
  EXPECT_NE(bndout.why({"xforce", 30}).find("30 velocity mat#, 30 velocity nd#"), std::string::npos);
  const Read spcforc(file(spcforc_text));
  EXPECT_EQ(spcforc.column({"forces z", 20}), (std::vector<Real>{0, 10.5, 21}));
  EXPECT_EQ(spcforc.last({"force resultants y", {}}), 7);
  const Read rwforc(file(rwforc_text));
  EXPECT_EQ(rwforc.column({"normal", 7}), (std::vector<Real>{0, 12.5, 25}));
  EXPECT_EQ(rwforc.last({"y", 7}), -25);
  EXPECT_EQ(rwforc.last({"normal", 8}), 0.5);
  EXPECT_EQ(rwforc.unit({"x", 7}), "ML/T2");
  const Read glstat(file([](const Sample& s) { return glstat_text(s, 0); }));
  EXPECT_EQ(glstat.column({"stonewall energy", 7}), (std::vector<Real>{0, 3.5, 7}));
  const Read sphout(file(sphout_text));
  EXPECT_EQ(sphout.column({"sig-zz", 17}), (std::vector<Real>{-3 - 1234.5, -3 - 2469.0, -3 - 3703.5}));
  EXPECT_EQ(sphout.last({"sig-zx", 17}), 6);
  EXPECT_EQ(sphout.last({"density", 17}), 1000);
  EXPECT_EQ(sphout.last({"neigh", 17}), 23);
  EXPECT_EQ(sphout.column({"act", 17}), (std::vector<Real>{0, 1, 1}));
  EXPECT_GT(sphout.last({"effsg", 17}), 1);
  EXPECT_EQ(sphout.unit({"sig-xx", 17}), "M/LT2");
}

// --- layouts of LS-DYNA; the numbers are made up

const std::string head = " a title\n                    ls-dyna smp d R16 R16.1_180 date 07/09/2025\n";

TEST(AsciiFile, GlstatOfLsDyna) {
  const std::string more =
      "\n\n number of shell elements that  \n reached the minimum time step..    3\n\n"
      "\n added mass.....................   0.28468E-03\n percentage increase............   0.22936E+05\n";
  const auto state = [&](const char* cycle, const char* t, const char* kinetic) {
    return "\n\n dt of cycle" + std::string(cycle) +
           " is controlled by solid         12 of part         3\n\n" + " time..........................." +
           t + "\n kinetic energy................." + kinetic +
           "\n stonewall energy...............   1.00000E+00 wall#  1\n"
           " stonewall energy...............   2.00000E+00 wall#  2\n"
           " hourglass energy ..............   4.00000E+00\n" +
           more;
  };
  const Read glstat(head + state("       1", "   0.00000E+00", "   0.17604-106") +
                    state("********", "   1.00000E-03", "**************") + head +  // restarted
                    state("       9", "   2.00000E-03", "  -0.10000D+02"));
  ASSERT_TRUE(glstat.whole()) << glstat.faults();
  const auto kinetic = glstat.column({"kinetic energy", {}}), cycle = glstat.column({"cycle", {}});
  EXPECT_EQ(kinetic[0], 0.17604e-106);
  EXPECT_TRUE(std::isnan(kinetic[1]) && std::isnan(cycle[1]));
  EXPECT_EQ(kinetic[2], -10);
  EXPECT_EQ(glstat.last({"stonewall energy", 2}), 2);
  EXPECT_EQ(glstat.last({"hourglass energy", {}}), 4);
  EXPECT_EQ(glstat.last({"added mass", {}}), 0.28468e-3);
  EXPECT_EQ(glstat.last({"reached the minimum time step", {}}), 3);
  EXPECT_EQ(glstat.unit({"percentage increase", {}}), "%");
}

TEST(AsciiFile, ContactsOfLsDyna) {
  const Read rcforc(
      head +
      "\n{BEGIN LEGEND}\n Entity #        Title\n        1     SURFA 3 time to slip\n{END LEGEND}\n\n"
      "  SURFA           1 time 0.00000E+00  x  1.00000E+00  y  2.00000E+00  z  3.00000E+00 mass  "
      "4.00000E+00  mx  5.00000E+00  my  6.00000E+00  mz  7.00000E+00\n"
      "  SURFB           1 time 0.00000E+00  x -1.00000E+00  y -2.00000E+00  z -3.00000E+00 mass  "
      "4.00000E+00  mx -5.00000E+00  my -6.00000E+00  mz -7.00000E+00\n"
      " interface number,         3,is single surface-resultants are undefined\n"
      " interface number,         3,is single surface-resultants are undefined\n");
  EXPECT_EQ(rcforc.last({"my", 1, "SURFB"}), -6) << rcforc.faults();
  EXPECT_EQ(rcforc.unit({"mz", 1, "SURFA"}), "ML2/T2");
  const Read older(
      head +
      "  slave           1 time 1.99800E-04  x  1.50000E+00  y  2.00000E+00  z -3.00000-101 mass  "
      "4.00000E+00\n"
      "  master          1 time 1.99800E-04  x ************  y  2.00000E+00  z  3.00000E+00 mass  "
      "4.00000E+00\n");
  EXPECT_EQ(older->times(), (std::vector<Real>{1.998e-4})) << older.faults();
  EXPECT_EQ(older.last({"x", 1, "SURFA"}), 1.5);
  EXPECT_EQ(older.last({"z", 1, "slave"}), -3e-101);
  EXPECT_TRUE(std::isnan(older.last({"x", 1, "SURFB"})));
  const Read sleout(
      head +
      "\n\n\n contact interface energy file, time= 0.4997700E-03\n"
      "    #             surfa       surfb        cycle=          1852    frictional\n\n"
      "         1   0.0000E+00   0.0000E+00                               0.0000E+00\n"
      "         3  -0.1286E-23   0.2500E+00                               0.9637E-21\n\n"
      " summary   total surfa side=-0.1286314E-23\n           total surfb side= 0.2500000E+00\n"
      "           total energy    = 0.2500000E+00\n           friction energy = 0.9637213E-21\n");
  EXPECT_EQ(sleout.last({"frictional", 3}), 0.9637e-21) << sleout.faults();
  EXPECT_EQ(sleout.last({"surfb", 3}), 0.25);
  EXPECT_EQ(sleout.last({"total friction", {}}), 0.9637213e-21);
  EXPECT_EQ(sleout.last({"cycle", {}}), 1852);
}

TEST(AsciiFile, MatsumOfLsDyna) {
  const auto state = [](const char* t, const char* energy) {
    return "\n\n time =" + std::string(t) + "\n mat.#=   21             inten=" + energy +
           "     kinen=   1.0000E+00\n x-mom=   2.0000E+00     y-mom=  -3.0000E+00     z-mom=   4.0000E+00\n"
           "                         hgeng=   5.0000E+00     +mass=   6.0000E+00\n\n\n\n"
           "       Maximum mass increase in solid elements      =   0.2122E-07 ID=   36456\n";
  };
  const Read matsum(head + state("   0.0000E+00", "   7.0000E+00") + state("   1.0000E-03", "*************"));
  EXPECT_EQ(matsum.column({"inten", 21})[0], 7) << matsum.faults();
  EXPECT_TRUE(std::isnan(matsum.last({"inten", 21})));
  EXPECT_EQ(matsum.last({"y-mom", {}}), -3);  // there is one part only
  EXPECT_EQ(matsum.last({"+mass", 21}), 6);
}

TEST(AsciiFile, OthersOfLsDyna) {
  const Read nodout(
      head +
      "\n\n\n n o d a l   p r i n t   o u t   f o r   t i m e  s t e p       1                       "
      "       ( at time 0.0000000E+00 )\n\n nodal point  x-disp     y-disp ...\n"
      "     4141  1.0000E+00-2.0000E-100-3.0000E+00************************  6.0000E+00  7.0000E+00  "
      "8.0000E+00  9.0000E+00  1.0000E+01  1.1000E+01  1.2000E+01\n");
  EXPECT_EQ(nodout.last({"y-disp", 4141}), -2e-100) << nodout.faults();
  EXPECT_EQ(nodout.last({"z-disp", 4141}), -3);
  EXPECT_TRUE(std::isnan(nodout.last({"x-vel", 4141})) && std::isnan(nodout.last({"y-vel", 4141})));
  EXPECT_EQ(nodout.last({"z-vel", 4141}), 6);
  EXPECT_EQ(nodout.last({"z-coor", 4141}), 12);
  const Read bndout(
      head +
      "\n n o d a l   f o r c e/e n e r g y    o u t p u t  t=   1.00000E-01\n\n"
      " discrete nodal point forces \n\n"
      " nd#    4513  xforce=   1.0000E+00   yforce=   0.0000E+00  zforce=  -1.0000E-02   energy=   "
      "2.1673E-08 xmoment=   3.0000E+00 ymoment=   0.0000E+00 zmoment=   0.0000E+00 setid=   7\n"
      "              xtotal=   8.0000E+00   ytotal=   0.0000E+00  ztotal=   0.0000E+00\n\n"
      " velocity boundary condition forces/rigid body moments \n\n"
      " nd#    4513  xforce=   2.0000E+00   yforce=   0.0000E+00  zforce=   0.0000E+00   energy=   "
      "0.0000E+00\n              xtotal=   9.0000E+00   ytotal=   0.0000E+00  ztotal=   0.0000E+00\n");
  EXPECT_EQ(bndout.last({"xforce", 4513, "discrete"}), 1) << bndout.faults();
  EXPECT_EQ(bndout.last({"xforce", 4513, "velocity"}), 2);
  EXPECT_EQ(bndout.last({"xmoment", 4513}), 3);
  EXPECT_EQ(bndout.last({"xtotal", {}, "velocity"}), 9);
  const Read spcforc(
      head +
      " output at time =   1.00000E-03\n"
      " node=       1 local x,y,z forces =    1.0000E+00    2.0000E+00   -3.0000E-11 setid=  4\n"
      " node=       1 local x,y,z forces =    1.5000E+00    2.0000E+00   -3.0000E-11 setid=  5\n"
      " node=       1 local x,y,z moments=    4.0000E+00    5.0000E+00    6.0000E+00 setid=  4\n"
      "             force resultants   =    7.0000E+00    8.0000E+00    9.0000E+00\n");
  EXPECT_EQ(spcforc.last({"forces x", 1, "setid 5"}), 1.5) << spcforc.faults();
  EXPECT_EQ(spcforc.last({"moments z", 1}), 6);
  EXPECT_EQ(spcforc.last({"force resultants z", {}}), 9);
  EXPECT_EQ(spcforc.unit({"moments z", 1}), "ML2/T2");
}

TEST(AsciiFile, RestartsReplaceWhatWasBefore) {
  const auto line = [](const char* t, const char* x) {
    return fmt::format(
        "  SURFA           1 time {}  x {}  y  0.00000E+00  z  0.00000E+00 mass  0.00000E+00\n", t, x);
  };
  const Read file(head + line("1.00000E+00", " 1.00000E+00") + line("2.00000E+00", " 2.00000E+00") +
                  line("3.00000E+00", " 3.00000E+00") + head + line("1.50000E+00", " 4.00000E+00") +
                  line("1.50000E+00", " 5.00000E+00"));  // two that look alike in six digits
  EXPECT_EQ(file->times(), (std::vector<Real>{1, 1.5, 1.5}));
  EXPECT_EQ(file.column({"x", 1}), (std::vector<Real>{1, 4, 5}));
  EXPECT_NE(file.faults().find("2 states before that were replaced"), std::string::npos) << file.faults();
}

// --- files that are not whole

TEST(AsciiFile, CutOffAnywhere) {
  using Text = std::string (*)(const Sample&);
  const Text texts[] = {[](const Sample& s) { return glstat_text(s, 4); },
                        matsum_text,
                        rcforc_text,
                        sleout_text,
                        nodout_text,
                        rbdout_text,
                        bndout_text,
                        spcforc_text,
                        sphout_text};
  for (const Text text : texts) {
    const std::string whole = file(text), last = text(sample(2));
    const std::string kind = Read(whole)->kind();
    const std::size_t begin = whole.size() - last.size();
    int wrong = 0;
    for (std::size_t cut = 1; cut < last.size(); cut += 7) {
      const std::string what = whole.substr(0, begin + cut);
      if (stripped(last.substr(cut)).find_first_not_of(" \n") == std::string::npos)
        continue;  // all numbers are there
      if (last.substr(0, cut).find_first_not_of(" \n1") == std::string::npos) continue;  // nothing begun
      const Read read(what);
      const auto line = std::count(what.begin(), what.end(), '\n') + (what.back() == '\n' ? 0 : 1);
      const bool told =
          read.faults().find(fmt::format("file:{}: error: not a line of a whole {}", line, kind)) == 0;
      if (read.whole() || !told) {
        if (++wrong == 1)
          ADD_FAILURE() << kind << " cut behind '" << what.substr(begin) << "': " << read.faults();
      }
    }
  }
}

TEST(AsciiFile, ForeignFiles) {
  EXPECT_EQ(Read("").faults().find(
                "file: error: up to its end the file has no state of a history\n  hint: glstat, "),
            0u)
      << Read("").faults();
  EXPECT_EQ(Read("*KEYWORD\n*END\n").faults().find("file:2: error: up to its end"), 0u);
  EXPECT_EQ(Read(head + std::string("\x89HDF\0\n", 6)).faults().find("file:3: error: this is no text file"),
            0u);
  const std::string whole = file(matsum_text);
  std::string broken = whole;
  broken.replace(broken.find("y-mom=") + 9, 4, "abcd");
  EXPECT_EQ(
      Read(broken).faults().find("file:7: error: not a line of a whole matsum: no number behind 'y-mom='"),
      0u)
      << Read(broken).faults();
  broken = whole;
  broken.replace(broken.find("mat.#=    1") + 6, 5, "*****");
  EXPECT_NE(Read(broken).faults().find("an id did not fit into its column"), std::string::npos);
  broken = file([](const Sample& s) { return glstat_text(s, 4); });
  broken.erase(broken.find(" time..."), 47);
  EXPECT_NE(Read(broken).faults().find("'time step' stands before the time of its state"), std::string::npos);
}

TEST(AsciiFile, Numbers) {
  const auto numbers = [](std::string_view text) { return take_numbers(text, 12); };
  EXPECT_EQ(numbers(" 1 -2.5 +.5 1.e3 1D2 1.5d-2 -1.0-100+2.0+100 3.0E-101-4.0"),
            (std::vector<Real>{1, -2.5, 0.5, 1000, 100, 0.015, -1e-100, 2e100, 3e-101, -4}));
  EXPECT_TRUE(std::isnan(numbers("NaN")[0]) && std::isinf(numbers(" -Infinity")[0]));
  EXPECT_EQ(numbers("************************").size(), 2u);
  EXPECT_EQ(numbers("1E400")[0], HUGE_VAL);
  EXPECT_TRUE(numbers("- 1").empty() && numbers(". 1").empty() && numbers("x").empty());
}

TEST(AsciiHistory, LinesWithoutWhatTheyAreToldBy) {
  // a head of bndout without "t=", of rcforc without its time
  for (const char* text : {"\n n o d a l   f o r c e/e n e r g y    o u t p u t\n\n nd#  30 xforce=  0.1\n",
                           "\n n o d a l   f o r c e/e n e r g y    o u t p u t   t\n"}) {
    const Read read(text);
    EXPECT_FALSE(read.whole());
    EXPECT_NE(read.faults().find("file:2: error: "), std::string::npos) << read.faults();
  }
}

}  // namespace
}  // namespace courant

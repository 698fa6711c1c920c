#include "search/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "../sph/cloud.hpp"
#include "base/run_error.hpp"

using namespace courant;
using courant::test::Cloud;

namespace {

/// Every active particle has every neighbour within its reach, and no particle twice; found by trying all
/// pairs.
void expect_complete(const Cloud& cloud) {
  const Particles& p = cloud.world.particles;
  for (Index i = 0; i < p.active; ++i) {
    std::set<Id> listed, wanted;
    for (const Index j : cloud.neighbours->of(p, i)) EXPECT_TRUE(listed.insert(p.id[j]).second) << "twice";
    EXPECT_EQ(listed.count(p.id[i]), 0u);
    for (Index j = 0; j < p.moving; ++j)
      if (j != i && (p.x.vec(i) - p.x.vec(j)).norm() < 2 * std::max(p.h[i], p.h[j])) wanted.insert(p.id[j]);
    EXPECT_TRUE(std::includes(listed.begin(), listed.end(), wanted.begin(), wanted.end()));
    for (Index j = p.moving; j < p.size(); ++j)
      if (p.state[j] != particle_deactivated)
        EXPECT_GE((p.x.vec(i) - p.place(j, cloud.clock.t)).norm(), 2 * p.h[i]) << "a neighbour sleeps";
  }
}

}  // namespace

TEST(Neighbours, FindWhatTryingAllPairsFinds) {
  for (const int dim : {2, 3})
    for (const Real jitter : {0.0, 0.4}) {
      Cloud cloud(dim, dim == 2 ? 25 : 9, 0.01, jitter);
      cloud.refresh();
      expect_complete(cloud);
    }
}

TEST(Neighbours, FindPairsOfUnequalSmoothingLengths) {
  Cloud cloud(2, 20, 0.01, 0.3);
  for (Index i = 0; i < cloud.world.particles.size(); i += 7) cloud.world.particles.h[i] *= 2.5;
  cloud.refresh();
  expect_complete(cloud);
}

TEST(Neighbours, SectionsTellWhoIsNearAndWhoseListHasThePairToo) {
  Cloud cloud(2, 25, 0.01, 0.3);
  for (Index i = 0; i < cloud.world.particles.size(); i += 7) cloud.world.particles.h[i] *= 1.5;
  cloud.neighbours = std::make_shared<Neighbours>(0.003, Region{Vec(0.02, -1, -1), Vec(1, 1, 1)});
  cloud.refresh();
  const Particles& p = cloud.world.particles;
  const Neighbours& lists = *cloud.neighbours;
  ASSERT_GT(p.moving, p.active) << "there is a halo";
  Index beyond = 0, later = 0, once = 0;
  for (Index i = 0; i < p.active; i += Neighbours::lanes) {
    const Index b = i / block_size, g = i % block_size / Neighbours::lanes;
    const Index end = std::min(i + Neighbours::lanes, p.active);
    const ListSections& at = lists.sections(b)[g];
    once += at.earlier - lists.starts(b)[g];
    for (Index k = lists.starts(b)[g]; k < lists.starts(b)[g + 1]; ++k) {
      const Index j = lists.list(b)[k];
      EXPECT_EQ(j >= end && j < p.active, k >= at.later && k < at.later_end);
      EXPECT_EQ(j < i, k >= at.earlier);
      later += k >= at.later && k < at.later_end;
      bool within = false;
      for (Index l = i; l < end; ++l)
        within |= (p.x.vec(l) - p.x.vec(j)).norm() < 2 * std::max(p.h[l], p.h[j]);
      EXPECT_EQ(within, k < (k < at.earlier ? at.beyond : at.earlier_beyond));
      beyond += within ? 0 : 1;
    }
  }
  EXPECT_GT(beyond, 0.1 * lists.entries());
  EXPECT_EQ(once, lists.entries_once());
  EXPECT_GT(later, 0.3 * lists.entries());
}

TEST(Neighbours, HoldEachPairOnceWhereNobodyNeedsItTwice) {
  for (const int dim : {2, 3}) {
    const int n = dim == 2 ? 25 : 9;
    Cloud both(dim, n, 0.01, 0.3), once(dim, n, 0.01, 0.3), all_the_same(dim, n, 0.01, 0.3);
    once.neighbours->cut_tasks();
    once.refresh(), both.refresh();
    expect_complete(once);
    EXPECT_LT(once.neighbours->entries(), 0.6 * both.neighbours->entries());
    EXPECT_EQ(once.neighbours->entries(), both.neighbours->entries_once());
    EXPECT_EQ(once.neighbours->entries(), once.neighbours->entries_once());
    EXPECT_THROW(once.neighbours->of_group(0), std::logic_error);
    with_whole_lists(all_the_same.neighbours)->cut_tasks();
    all_the_same.refresh();
    EXPECT_EQ(all_the_same.neighbours->entries(), both.neighbours->entries());
    EXPECT_FALSE(all_the_same.neighbours->of_group(0).empty());
  }
}

TEST(Tasks, CoverAllParticlesAndWhatTheirListsReach) {
  for (const int side : {8, 15})
    for (const int threads : {1, 3}) {
      static std::vector<Index> cuts;
      set_threads(threads);
      Cloud cloud(3, side, 0.01, 0.2);
      cloud.neighbours->cut_tasks();
      cloud.refresh();
      const Neighbours& lists = *cloud.neighbours;
      const Tasks& tasks = lists.tasks();
      const Index n = cloud.world.particles.active;
      ASSERT_GE(tasks.count(), 8);
      Index begin = 0, room = 0;
      std::vector<Index> found;
      for (Index s = 0; s < tasks.count(); ++s) {
        EXPECT_EQ(tasks[s].begin, begin);
        EXPECT_EQ(tasks[s].begin % block_size, 0);
        EXPECT_EQ(tasks[s].offset, room);
        Index last = tasks[s].end - 1;
        for (Index b = tasks[s].begin / block_size; b < block_count(tasks[s].end); ++b) {
          EXPECT_EQ(tasks.of_block(b), s);
          for (Index e = 0; e < lists.entries(b); ++e)
            if (lists.list(b)[e] < n) last = std::max(last, lists.list(b)[e]);
        }
        EXPECT_EQ(tasks[s].reach, last + 1);
        for (Index other = 0; other < s; ++other)
          EXPECT_TRUE(tasks[other].reach <= tasks[s].begin || other >= tasks[s].earliest);
        begin = tasks[s].end, room += tasks[s].reach - tasks[s].begin;
        found.push_back(tasks[s].end);
      }
      EXPECT_EQ(begin, n);
      EXPECT_EQ(tasks.total(), room);
      for (const Index b : cloud.world.shares.first)
        EXPECT_TRUE(b == block_count(n) || tasks[tasks.of_block(b)].begin == b * block_size);
      if (threads == 1) cuts = found;
      EXPECT_EQ(found, cuts) << "as many threads as there may be";
    }
  set_threads(0);
}

TEST(Neighbours, StayCompleteUntilTheyRebuildThemselves) {
  Cloud cloud(2, 20, 0.01, 0.2);
  cloud.refresh();
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> u(-1, 1);
  for (int step = 0; step < 60; ++step) {
    for (Index i = 0; i < cloud.world.particles.size(); ++i)
      cloud.world.particles.x.add(i, Vec(u(random), u(random), 0) * 2e-4);
    cloud.refresh();
    expect_complete(cloud);
  }
  EXPECT_GT(cloud.neighbours->rebuilds(), 2);
  EXPECT_LT(cloud.neighbours->rebuilds(), 60);
}

// Contact looks at the walls that are near when lists are built; they must be built anew before others are.
TEST(Neighbours, RebuildWhenAWallHasMovedByHalfTheSkin) {
  Cloud cloud(2, 6, 0.01, 0);
  World& world = cloud.world;
  world.nodes.fields.resize(6);
  for (Index k = 0; k < 6; ++k) world.nodes.x.set(k, {0.01 * k, -0.05, 0});
  world.nodes.held[3] = 1;
  Segments& s = world.segments;
  s.fields.resize(1);
  s.node0[0] = 0, s.node1[0] = 1, s.node2[0] = 2, s.node3[0] = 3;  // 4 and 5 are on no face
  const Real skin = cloud.neighbours->skin();
  cloud.refresh();
  const auto rebuilds_after = [&](Index node, const Vec& move) {
    world.nodes.x.add(node, move);
    ++cloud.clock.cycle;
    cloud.refresh();
    return cloud.neighbours->rebuilds();
  };
  EXPECT_EQ(rebuilds_after(2, {0, 0.45 * skin, 0}), 1);
  EXPECT_EQ(rebuilds_after(2, {0, 0.1 * skin, 0}), 2);
  EXPECT_EQ(rebuilds_after(2, {0, 0, -0.45 * skin}), 2);  // from where it was then
  EXPECT_EQ(rebuilds_after(1, {0, 0, 0.55 * skin}), 3);
  EXPECT_EQ(rebuilds_after(0, {-0.3 * skin, 0.3 * skin, 0.3 * skin}), 4);
  EXPECT_EQ(rebuilds_after(3, {0, 5 * skin, 0}), 4);
  EXPECT_EQ(rebuilds_after(4, {0, 5 * skin, 0}), 4);
}

TEST(Neighbours, StayCompleteWhereSomeGrow) {
  // every fifth particle grows, and the others come towards those in the middle
  Cloud cloud(2, 20, 0.01, 0.2);
  cloud.refresh();
  Particles& p = cloud.world.particles;
  const Vec middle(0.1, 0.1, 0);
  for (int step = 0; step < 60; ++step) {
    for (Index i = 0; i < p.size(); ++i) {
      const Vec inwards = middle - p.x.vec(i);
      if (p.id[i] % 5 == 0)
        p.h[i] += 1e-4;
      else
        p.x.add(i, (1e-4 / (0.01 + inwards.norm())) * inwards);
    }
    cloud.refresh();
    expect_complete(cloud);
  }
  EXPECT_LT(cloud.neighbours->rebuilds(), 60);
}

TEST(Neighbours, CopeWithAParticleFarAway) {
  Cloud cloud(3, 6, 0.01, 0.2);
  cloud.world.particles.x.set(0, {1e6, -1e6, 1e5});
  cloud.refresh();
  expect_complete(cloud);
}

TEST(Neighbours, TheBoxSplitsActiveRimAndDormant) {
  Cloud cloud(2, 40, 0.01, 0);
  Particles& p = cloud.world.particles;
  for (Index i = 0; i < p.size(); ++i) p.v.set(i, {1, 0, 0});
  cloud.neighbours =
      std::make_shared<Neighbours>(0.003, Neighbours::Region{Vec(0.195, -1, -1), Vec(0.255, 1, 1)});
  cloud.refresh();
  EXPECT_EQ(p.active, 6 * 40);
  expect_complete(cloud);
  for (Index i = 0; i < p.size(); ++i) {
    const bool inside = p.x.vec(i)[0] > 0.195 && p.x.vec(i)[0] < 0.255;
    EXPECT_EQ(inside, i < p.active);
    EXPECT_EQ(p.state[i] == particle_active, inside);
  }
  // dormant particles drift with their velocity although nobody touches them in between
  std::map<Id, Real> before;
  for (Index i = 0; i < p.size(); ++i) before[p.id[i]] = p.x.vec(i)[0];
  for (int step = 0; step < 40; ++step) {
    for (Index i = 0; i < p.moving; ++i) p.x.add(i, Vec(0.001, 0, 0));
    cloud.clock.t += 0.001;
    cloud.refresh();
    expect_complete(cloud);
  }
  cloud.neighbours->force_refresh();
  cloud.refresh();
  for (Index i = 0; i < p.size(); ++i) EXPECT_NEAR(p.x.vec(i)[0], before[p.id[i]] + 0.04, 1e-12);
}

TEST(Neighbours, WakeParticlesInTimeAlsoWhereHGrows) {
  Cloud cloud(2, 60, 0.01, 0);
  Particles& p = cloud.world.particles;
  for (Index i = 0; i < p.size(); ++i) p.v.set(i, {i % 2 == 0 ? 1.0 : 0.3, 0, 0});
  cloud.neighbours =
      std::make_shared<Neighbours>(0.003, Neighbours::Region{Vec(0.495, 0.2, -1), Vec(9, 0.3, 1)});
  cloud.refresh();
  EXPECT_LT(p.moving, p.size());
  const Index first = p.moving;
  for (int step = 0; step < 120; ++step) {
    for (Index i = 0; i < p.moving; ++i) {
      p.x.add(i, p.v.vec(i) * 0.001);
      if (step % 10 == 0) p.h[i] *= 1.05;
    }
    cloud.clock.t += 0.001;
    cloud.refresh();
    expect_complete(cloud);
  }
  EXPECT_GT(p.moving, first);
}

TEST(Neighbours, TheLastDormantParticlesComeInWhereTheyShould) {
  Cloud cloud(2, 40, 0.01, 0);
  Particles& p = cloud.world.particles;
  std::map<Id, Real> before;
  for (Index i = 0; i < p.size(); ++i) {
    p.v.set(i, {1, 0, 0});
    p.h[i] *= 0.2;  // small, so that most are woken far away, and in batches
    before[p.id[i]] = p.x.vec(i)[0];
  }
  cloud.neighbours =
      std::make_shared<Neighbours>(0.0005, Neighbours::Region{Vec(0.385, -1, -1), Vec(9, 1, 1)});
  cloud.refresh();
  EXPECT_LT(p.moving, p.size());
  for (int step = 1; step <= 500; ++step) {
    for (Index i = 0; i < p.moving; ++i) p.x.add(i, p.v.vec(i) * 0.001);
    cloud.clock.t += 0.001;
    cloud.refresh();
    for (Index i = 0; i < p.size(); ++i)
      EXPECT_NEAR(p.place(i, cloud.clock.t)[0], before[p.id[i]] + 0.001 * step, 1e-12) << "step " << step;
    if (HasFailure()) return;
  }
  EXPECT_EQ(p.active, p.size());
}

TEST(Neighbours, CrossingTheBorderOfTheBoxCountsAtOnce) {
  Cloud cloud(2, 10, 0.01, 0);
  Particles& p = cloud.world.particles;
  cloud.neighbours =
      std::make_shared<Neighbours>(0.003, Neighbours::Region{Vec(-1, -1, -1), Vec(0.0401, 1, 1)});
  cloud.refresh();
  EXPECT_EQ(p.active, 50);
  p.x.add(p.active, Vec(-0.001, 0, 0));  // far less than the skin: stays outside
  cloud.refresh();
  EXPECT_EQ(cloud.neighbours->rebuilds(), 1);
  Index last = 0;
  for (Index i = 0; i < p.active; ++i)
    if (p.x.vec(i)[0] > p.x.vec(last)[0]) last = i;
  const Id leaving = p.id[last];
  p.x.add(last, Vec(0.0002, 0, 0));  // as little, but across
  cloud.refresh();
  EXPECT_EQ(cloud.neighbours->rebuilds(), 2);
  EXPECT_EQ(p.active, 49);
  ASSERT_EQ(cloud.neighbours->left().size(), 1u);
  const Index outside = cloud.neighbours->left()[0];
  EXPECT_EQ(p.id[outside], leaving);
  p.x.add(outside, Vec(-0.0002, 0, 0));
  cloud.refresh();
  EXPECT_EQ(p.active, 50);
  ASSERT_EQ(cloud.neighbours->entered().size(), 1u);
  EXPECT_EQ(p.id[cloud.neighbours->entered()[0]], leaving);
}

TEST(Neighbours, StopWhereAPlaceIsNoNumber) {
  for (const Real lost :
       {std::nan(""), std::numeric_limits<Real>::infinity(), -std::numeric_limits<Real>::infinity()}) {
    Cloud cloud(2, 6, 0.01, 0.1);
    cloud.refresh();
    cloud.world.particles.x.set(4, {0.01, lost, 0});
    const Id id = cloud.world.particles.id[4];
    try {
      cloud.refresh();
      FAIL() << "went on with " << lost;
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what()).find("particle " + std::to_string(id) + " "), std::string::npos)
          << error.what();
    }
  }
}

TEST(Neighbours, CopeWithNoParticleAndWithOne) {
  for (const Index n : {0, 1}) {
    Cloud cloud(2, 2, 0.01, 0);
    Particles& p = cloud.world.particles;
    p.fields.resize(n);
    cloud.refresh();
    EXPECT_EQ(p.active, n);
    EXPECT_EQ(cloud.neighbours->entries(), n);
    cloud.refresh();
  }
}

TEST(Neighbours, SortEveryFieldTheSameWay) {
  Cloud cloud(3, 8, 0.01, 0.3, 1.2, 5);
  Particles& p = cloud.world.particles;
  Field<Real>& one = p.fields.add<Real>({.name = "one", .dimension = "-"});
  Field<Real>& three = p.fields.add<Real>({.name = "three", .dimension = "-", .components = 3});
  std::map<Id, Vec> places;
  for (Index i = 0; i < p.size(); ++i) {  // every value tells whose it is
    p.id[i] = 1 + (i * 37) % p.size();
    const Real tag = static_cast<Real>(p.id[i]);
    for (Field<Real>* f : {&p.m, &p.rho, &p.drhodt, &p.p, &p.c, &p.E, &one}) (*f)[i] = tag;
    for (Field<Real>* f : {&p.v, &p.f, &three}) f->set(i, {tag, 2 * tag, 3 * tag});
    p.part[i] = static_cast<Index>(tag);
    places[p.id[i]] = p.x.vec(i);
  }
  cloud.refresh();
  bool moved = false;
  for (Index i = 0; i < p.size(); ++i) {
    moved |= p.id[i] != 1 + (i * 37) % p.size();
    const Real tag = static_cast<Real>(p.id[i]);
    for (Field<Real>* f : {&p.m, &p.rho, &p.drhodt, &p.p, &p.c, &p.E, &one})
      EXPECT_EQ((*f)[i], tag) << f->info().name;
    for (Field<Real>* f : {&p.v, &p.f, &three})
      EXPECT_EQ(f->vec(i), Vec(tag, 2 * tag, 3 * tag)) << f->info().name;
    EXPECT_EQ(p.part[i], static_cast<Index>(tag));
    EXPECT_EQ(p.x.vec(i), places[p.id[i]]);
  }
  EXPECT_TRUE(moved);
}

// Whatever stood before: what lists were built at another time, and in which order particles were given.
TEST(Neighbours, OrderFollowsFromPositionsAndIdsAlone) {
  for (const int dim : {2, 3})
    for (const bool box : {false, true}) {
      const int n = dim == 2 ? 25 : 9;
      std::vector<std::vector<Id>> orders, lists;
      for (const bool shuffle : {false, true}) {
        Cloud cloud(dim, n, 0.01, 0.4);
        if (box)
          cloud.neighbours = std::make_shared<Neighbours>(0.003, Region{Vec(0.03, -1, -1), Vec(1, 1, 1)});
        Particles& p = cloud.world.particles;
        if (shuffle) {
          std::vector<Index> order(static_cast<std::size_t>(p.size()));
          std::iota(order.begin(), order.end(), 0);
          std::shuffle(order.begin(), order.end(), std::mt19937(3));
          p.fields.permute(order);
          cloud.refresh();
          for (Index i = 0; i < p.size(); ++i) {  // a quarter of a turn, and back
            const Vec x = p.x.vec(i);
            p.v.set(i, x);
            p.x.set(i, Vec(0.01 * n - x[1], x[0], x[2]));
          }
          cloud.neighbours->force_refresh();
          cloud.refresh();
          for (Index i = 0; i < p.size(); ++i) p.x.set(i, p.v.vec(i)), p.v.set(i, Vec::Zero());
          p.moving = p.size();
          cloud.neighbours->force_refresh();
        }
        cloud.refresh();
        orders.emplace_back(p.id.data(), p.id.data() + p.moving);
        std::vector<Id>& list = lists.emplace_back();
        for (Index g = 0; g * Neighbours::lanes < p.active; ++g)
          for (const Index j : cloud.neighbours->listed(g)) list.push_back(p.id[j]);
      }
      EXPECT_EQ(orders[0], orders[1]);
      EXPECT_EQ(lists[0], lists[1]);
    }
}

// *DATABASE_EXAMPLE_MOMENTUM: momentum of all that moves by its forces, over time, in the file `momentum`.
#include <fmt/format.h>

#include "extension/additions.hpp"
#include "extension/compiled_against.hpp"
#include "keyword/registry.hpp"
#include "parallel/parallel.hpp"

namespace {

using namespace courant;

struct Card : Entry {
  Real dt = 0;
};

const RegisterKeyword<Card> keyword{
    {.names = {"DATABASE_EXAMPLE_MOMENTUM"},
     .purpose = "time and momentum, one line for each state",
     .once = true,
     .many = false,
     .cards = {{.fields = {{"DT", &Card::dt, "T", "interval, 0 none", {.check = Check::not_negative}}}}}}};

Vec momentum(const Field<Real>& m, const Field<Real>& v, Index count, const Field<Index>* follow) {
  Vec p = Vec::Zero();
  for (int k = 0; k < 3; ++k)
    p[k] = sum(count, [&](Index i) { return follow && (*follow)[i] ? 0 : m[i] * v.data(k)[i]; });
  return p;
}

const RegisterAsciiHistory registered{
    {.name = "momentum",
     .interval = [](const Deck& deck) { return deck.last<Card>() ? deck.last<Card>()->dt : 0; },
     .text =
         [](const World& world, const Clock& clock) {
           const Particles& particles = world.particles;
           const Nodes& nodes = world.nodes;
           const Vec p = momentum(particles.m, particles.v, particles.active, nullptr) +
                         momentum(nodes.m, nodes.v, nodes.size(), &nodes.follow);
           return fmt::format("{:.6e} {:.9e} {:.9e} {:.9e}\n", clock.t, p[0], p[1], p[2]);
         }}};

}  // namespace

// What *COURANT_TURBULENCE means, and what is refused of it.
#include <fmt/format.h>

#include "keyword/registry.hpp"
#include "model/mesh/named_parts.hpp"
#include "sph/sph.hpp"
#include "sph/turbulence/turbulence_cards.hpp"

namespace courant {

namespace {

using T = CourantTurbulence;

KeywordOf<T> courant_turbulence() {
  constexpr FieldRules factor{.check = Check::positive};
  const auto of = [&](Real standard) {
    FieldRules rules = factor;
    rules.standard = standard;
    return rules;
  };
  return {
      .names = {"COURANT_TURBULENCE"},
      .purpose = "turbulence: mixing length by the distance from any wall, k-epsilon, or Smagorinsky",
      .once = true,
      .many = false,
      .cards = {
          {.fields =
               {{"MODEL",
                 &T::model,
                 "-",
                 "1 mixing length, 2 k-epsilon, 3 Smagorinsky",
                 {.required = true, .allowed = {1, 2, 3}}},
                {"CMU", &T::cmu, "-", "c_mu: of l^2 |S|, or of k^2/epsilon", of(0.09)},
                {"KAPPA", &T::kappa, "-", "length over the distance from the nearest wall", of(0.41)},
                {"LMAX",
                 &T::lmax,
                 "L",
                 "longest mixing length (MODEL 1); length of the largest eddies, about 0.1 of the depth: "
                 "epsilon is at least c_mu^0.75 k^1.5/LMAX (MODEL 2; 0: free)",
                 {.check = Check::not_negative}},
                {"SURF",
                 &T::surface,
                 "-",
                 "a of the factor min(1, (a/(h |sum V grad W|))^3) on l, which ends turbulence at the "
                 "surface (MODEL 1); 0: none",
                 {.check = Check::not_negative}},
                {"CS", &T::cs, "-", "length over the spacing of particles (MODEL 3)", of(0.17)},
                {"WALLB",
                 &T::wallb,
                 "-",
                 "the walls: a part or a set of parts; 0: all shells",
                 {.check = Check::not_negative},
                 [](const T& c) { return c.wallbtyp == 2 ? IdSpace::part_set : IdSpace::part; }},
                {"WALLBTYP", &T::wallbtyp, "-", "2 part set, 3 part", {.standard = 3, .allowed = {2, 3}}}}},
          {.fields =
               {{"C1", &T::c1, "-", "of the production of epsilon", of(1.44)},
                {"C2", &T::c2, "-", "of its decay", of(1.92)},
                {"SIGK", &T::sigma_k, "-", "nu_t over the diffusivity of k", of(1)},
                {"SIGE", &T::sigma_e, "-", "nu_t over the diffusivity of epsilon", of(1.3)},
                {"K",
                 &T::k,
                 "L2/T2",
                 "k at the start, of parts without a card of their own",
                 {.check = Check::not_negative}},
                {"EPS", &T::epsilon, "L2/T3", "epsilon at the start", {.check = Check::not_negative}},
                {"LIMIT",
                 &T::limit,
                 "-",
                 "of the shear stress, sqrt(c_mu) k: 0 in the production of k alone; 1 in nu_t, too",
                 {.allowed = {0, 1}}},
                {"LSURF",
                 &T::lsurf,
                 "L",
                 "length of the largest eddies at free surfaces, about 0.07 of the depth: epsilon is at "
                 "least c_mu^0.75 k^1.5/LSURF there; 0: free",
                 {.check = Check::not_negative}}},
           .optional = true}}};
}
const RegisterKeyword<T> turbulence_keyword{courant_turbulence()};

const RegisterKeyword<CourantTurbulenceInitial> turbulence_initial_keyword{
    courant_turbulence_initial_table()};

void read_initial_turbulence(const Deck& deck, const Model& model, TurbulenceRules& t,
                             Diagnostics& diagnostics) {
  for (const auto& c : deck.all<CourantTurbulenceInitial>()) {
    const auto part = model.part_of_id.find(c.pid);
    if (part == model.part_of_id.end() || !model.parts[static_cast<std::size_t>(part->second)].has_sph) {
      deck.error(diagnostics, c, "PID",
                 fmt::format("part {} {}", c.pid,
                             part == model.part_of_id.end() ? "does not exist" : "has no particles"));
      continue;
    }
    if (t.model != TurbulenceModel::k_epsilon)
      deck.error(diagnostics, c, "K", "the model of *COURANT_TURBULENCE has no k",
                 "give MODEL 2, or leave the keyword out");
    t.k[static_cast<std::size_t>(part->second)] = c.k;
    t.epsilon[static_cast<std::size_t>(part->second)] = c.epsilon;
  }
}

void check_numbers(const Deck& deck, const T& c, const SphSettings& s, Diagnostics& diagnostics) {
  const auto model = static_cast<TurbulenceModel>(c.model);
  if (model == TurbulenceModel::k_epsilon && !(c.c2 > 1 + 1e-6 && c.c2 > c.c1))
    deck.error(diagnostics, c, "C2", "expected more than C1 and than 1: else turbulence never decays");
  if (model == TurbulenceModel::mixing_length && !(c.lmax > 0))
    deck.error(diagnostics, c, "LMAX", "MODEL 1 needs the longest mixing length",
               "give a part of the depth, as 0.1 to 0.5 of it");
  const auto belongs_to = [&](TurbulenceModel owner, const char* field, Real value) {
    if (value > 0 && model != owner)
      deck.error(diagnostics, c, field, fmt::format("MODEL {} does not use it", c.model),
                 fmt::format("leave it blank, or give MODEL {}", static_cast<int>(owner)));
  };
  if (model == TurbulenceModel::smagorinsky && c.lmax > 0)
    deck.error(diagnostics, c, "LMAX", "MODEL 3 does not use it", "leave it blank, or give MODEL 1 or 2");
  belongs_to(TurbulenceModel::mixing_length, "SURF", c.surface);
  belongs_to(TurbulenceModel::k_epsilon, "K", c.k);
  belongs_to(TurbulenceModel::k_epsilon, "EPS", c.epsilon);
  belongs_to(TurbulenceModel::k_epsilon, "LIMIT", c.limit);
  belongs_to(TurbulenceModel::k_epsilon, "LSURF", c.lsurf);
  if ((c.k > 0) != (c.epsilon > 0))
    deck.error(diagnostics, c, c.k > 0 ? "EPS" : "K", "K and EPS belong together",
               "give both, or none: epsilon = CMU^0.75 k^1.5/l with the length l of the largest eddies");
  if (s.mixing_length.most > 0)
    deck.error(diagnostics, c, "MODEL", "*COURANT_EDDY_VISCOSITY is a turbulence model, too",
               "give one of the two");
}

}  // namespace

void read_turbulence(const Deck& deck, const Model& model, const World& world, SphSettings& s,
                     Diagnostics& diagnostics) {
  const auto* c = deck.last<T>();
  if (c == nullptr)
    for (const CourantTurbulenceInitial& start : deck.all<CourantTurbulenceInitial>())
      deck.error(diagnostics, start, "", "the deck has no turbulence model that k and epsilon start",
                 "add *COURANT_TURBULENCE with MODEL 2, or leave the card out");
  if (c == nullptr || model.sph.empty()) return;
  check_numbers(deck, *c, s, diagnostics);
  TurbulenceRules& t = s.turbulence;
  t = {.model = static_cast<TurbulenceModel>(c->model),
       .cmu = c->cmu,
       .kappa = c->kappa,
       .lmax = c->lmax,
       .surface = c->surface,
       .cs = c->cs,
       .c1 = c->c1,
       .c2 = c->c2,
       .sigma_k = c->sigma_k,
       .sigma_e = c->sigma_e,
       .limits_stress = c->limit == 1,
       .surface_length = c->lsurf,
       .k = std::vector<Real>(model.parts.size(), c->k),
       .epsilon = std::vector<Real>(model.parts.size(), c->epsilon),
       .walls = {}};
  read_initial_turbulence(deck, model, t, diagnostics);
  std::vector<char> chosen(model.parts.size(), 1);
  if (c->wallb != 0) chosen = shell_parts_named(deck, model, *c, "WALLB", c->wallb, c->wallbtyp, diagnostics);
  for (Index k = 0; k < world.segments.size(); ++k)
    if (model.parts[world.segments.part[k]].has_shell && chosen[world.segments.part[k]]) t.walls.push_back(k);
  if (s.mu.empty()) s.mu.assign(model.parts.size(), 0);
}

}  // namespace courant

// *DEFINE_FRICTION
#include "contact/friction.hpp"

#include <fmt/format.h>

#include <vector>

#include "contact/cards.hpp"
#include "keyword/conversion.hpp"
#include "keyword/deck.hpp"
#include "keyword/registry.hpp"
#include "model/model.hpp"

namespace courant {

namespace {

using DF = DefineFriction;
const RegisterKeyword<DF> define_friction{define_friction_table()};

constexpr Real by_table = -2;

class FrictionReader {
 public:
  FrictionReader(const Deck& deck, const Model& model, const ContactCard& card, Diagnostics& diagnostics)
      : deck_(deck), model_(model), card_(card), diagnostics_(diagnostics) {}

  FrictionLaw read() {
    FrictionLaw out;
    if (card_.fs >= 0) {
      static_cast<Friction&>(out) = scaled({card_.fs, card_.fd, card_.dc, card_.vc});
      return out;
    }
    const DF* const table = card_.fs == by_table ? find() : nullptr;
    if (card_.fs != by_table)
      deck_.error(diagnostics_, card_, "FS", fmt::format("'{:g}' is not supported", card_.fs),
                  "a coefficient >= 0, or -2 with a *DEFINE_FRICTION");
    if (!table) return out;
    static_cast<Friction&>(out) = scaled({table->fs_d, table->fd_d, table->dc_d, table->vc_d});
    FrictionTable pairs;
    for (std::size_t k = 0; k < table->pid_i.size(); ++k) {
      const Friction mu = scaled({table->fs_ij[k], table->fd_ij[k], table->dc_ij[k], table->vc_ij[k]});
      for (const Index i : parts(*table, "PID_I", table->pid_i[k], table->ptypei[k]))
        for (const Index j : parts(*table, "PID_J", table->pid_j[k], table->ptypej[k]))
          pairs[std::minmax(i, j)] = mu;
    }
    out.table = std::make_shared<FrictionTable>(std::move(pairs));
    return out;
  }

 private:
  Friction scaled(Friction mu) const {
    mu.fs *= card_.fsf, mu.fd *= card_.fsf, mu.vc *= card_.vsf;
    return mu;
  }
  const DF* find() {
    const auto& all = deck_.all<DF>();
    const DF* out = nullptr;
    const auto wanted = static_cast<Id>(card_.fd);
    for (const DF& one : all)
      if (wanted == 0 || one.id == wanted) out = &one;
    if (!out)
      deck_.error(diagnostics_, card_, wanted == 0 ? "FS" : "FD",
                  wanted == 0 ? std::string("-2 asks for a *DEFINE_FRICTION, and there is none")
                              : fmt::format("friction table {} does not exist", wanted),
                  "define it with *DEFINE_FRICTION");
    else if (wanted == 0 && all.size() > 1)
      deck_.error(diagnostics_, card_, "FD",
                  fmt::format("there are {} tables of *DEFINE_FRICTION", all.size()), "give the ID of one");
    return out;
  }
  std::vector<Index> parts(const DF& table, const char* field, Id id, const std::string& kind) {
    const bool set = kind == "PSET";
    if (!set && !kind.empty())
      deck_.error(diagnostics_, table, field[4] == 'I' ? "PTYPEI" : "PTYPEJ",
                  fmt::format("'{}' is not supported", kind), "blank for a part, PSET for a set of parts");
    const auto part = model_.part_of_id.find(id);
    const auto members = model_.part_sets.find(id);
    if (set && members != model_.part_sets.end()) return members->second;
    if (!set && part != model_.part_of_id.end()) return {part->second};
    if (table.icnep == 0)
      deck_.error(diagnostics_, table, field,
                  fmt::format("{} {} does not exist", set ? "part set" : "part", id),
                  "define it, or let lines of missing parts not count (ICNEP 1)");
    return {};
  }

  const Deck& deck_;
  const Model& model_;
  const ContactCard& card_;
  Diagnostics& diagnostics_;
};

}  // namespace

FrictionLaw friction_of_card(const Deck& deck, const Model& model, const ContactCard& card,
                             Diagnostics& diagnostics) {
  return FrictionReader(deck, model, card, diagnostics).read();
}

std::string keep_sets_of_friction(DefineFriction& table, const Conversion& conversion) {
  if (conversion.offsets.part == conversion.offsets.set) return {};
  for (const auto* kinds : {&table.ptypei, &table.ptypej})
    for (const std::string& kind : *kinds)
      if (!kind.empty()) return "numbers of sets of parts get the offset of parts";
  return {};
}

}  // namespace courant

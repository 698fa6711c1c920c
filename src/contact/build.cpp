#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_set>

#include "contact/cards.hpp"
#include "contact/contact.hpp"
#include "contact/nodes/build.hpp"
#include "contact/particle_springs.hpp"
#include "model/mesh/named_parts.hpp"
#include "state/shared_fields.hpp"
#include "surfaces/contact_offset.hpp"
#include "surfaces/contact_thickness.hpp"
#include "surfaces/skin.hpp"

namespace courant {
namespace {

class ParticleContactBuilder {
 public:
  ParticleContactBuilder(const Deck& deck, const Model& model, const ContactOptions& options, World& world,
                         Diagnostics& diagnostics)
      : deck_(deck), model_(model), options_(options), world_(world), diagnostics_(diagnostics) {}

  /// Particles of SURFA, which may have nodes of elements, too, in SABOXID; reports a missing side.
  std::vector<bool> tracked(const ContactCard& c) {
    std::vector<bool> out = particles_of(c);
    FaceFinder finder(deck_, model_, options_.bulk_modulus, world_, diagnostics_);
    const Box* const box = finder.box_of(c, ContactSide::a);
    if (!box || std::find(out.begin(), out.end(), true) == out.end()) return out;
    for (Index i = 0; i < world_.particles.size(); ++i)
      out[i] = out[i] && box->contains(world_.particles.x.vec(i));
    if (std::find(out.begin(), out.end(), true) == out.end())
      deck_.warning(diagnostics_, c, "SABOXID", fmt::format("no particle of SURFA is in box {}", box->id),
                    "the box holds what it contains at the start");
    return out;
  }

  /// What acts on faces only.
  void refuse_for_particles(const ContactCard& c) {
    const auto refuse = [&](const char* field, const auto& value, bool given, const char* instead) {
      if (given)
        deck_.refuse(diagnostics_, c, field,
                     fmt::format("'{}' is not supported where SURFA has particles", value), instead);
    };
    refuse("SURFATYP", c.surfatyp, c.surfatyp == 0 || c.surfatyp == 1, "supported values: 2, 3, 4, 5, 6");
    if (c.soft == 2)
      deck_.warning(diagnostics_, c, "SOFT", "2 (faces on faces) runs as 1 for particles",
                    "give 1 where that is meant");
    refuse("PENMAX", c.penmax, c.penmax > 0, "leave the field blank or 0");
    refuse("SLDTHK", c.sldthk, c.sldthk > 0, "give SBST, twice the distance at which particles touch");
    refuse("SLDSTF", c.sldstf, c.sldstf > 0, "scale the stiffness with SFSB");
  }

  /// Segments of SURFB
  std::vector<Index> segments(const ContactCard& c) {
    if ((c.surfbtyp != 2 && c.surfbtyp != 3) || c.surfb == 0) return named_faces(c);
    std::vector<char> chosen(model_.parts.size(), 0);
    std::vector<Index> out, skin;
    for (const Index part : parts_named(deck_, model_, c, "SURFB", c.surfb, c.surfbtyp, diagnostics_)) {
      const ModelPart& named = model_.parts[part];
      chosen[part] = named.has_shell;
      if (!named.has_shell && !named.has_solid)
        deck_.error(diagnostics_, c, "SURFB", fmt::format("part {} has no shells and no solids", named.id),
                    "SURFB must be parts of shells or solids");
      if (!named.has_solid) continue;
      for (const Index s : add_skin(world_, {part, options_.bulk_modulus(part)})) skin.push_back(s);
    }
    if (!skin.empty() && !(c.sast > 0) && !(c.sbst > 0) && !options_.thickness_from_volume)
      deck_.error(diagnostics_, c, "SAST",
                  "neither particles nor the faces of solids have a thickness, so they would never touch",
                  "give SAST, or SBST, twice the distance at which they touch; or ITHK 1 of *CONTROL_SPH");
    for (Index s = 0; s < world_.segments.size(); ++s)
      if (chosen[world_.segments.part[s]] && !(world_.segments.volume[s] > 0)) out.push_back(s);
    for (const Index s : skin)
      if (goes_inside(c) || !is_hidden(s)) out.push_back(s);
    FaceFinder finder(deck_, model_, options_.bulk_modulus, world_, diagnostics_);
    finder.leave_out_symmetric(c, out);
    const bool any = !out.empty();
    finder.keep_in_box(c, ContactSide::b, out);
    if (any && out.empty() && model_.boxes.contains(c.sbboxid))
      deck_.warning(diagnostics_, c, "SBBOXID", fmt::format("no face of SURFB is in box {}", c.sbboxid),
                    "all corners of a face must be in it at the start");
    finder.are_stiff(c, out, c.soft != 0);
    refuse_lifted(c, out);
    return out;
  }

 private:
  /// Particles touch shells at their nodes.
  void refuse_lifted(const ContactCard& c, const std::vector<Index>& faces) {
    const Segments& g = world_.segments;
    const auto lifted = [&](Index s) { return contact_offset(g, s, 0.5 * contact_thickness(g, s)) != 0; };
    if (const auto one = std::find_if(faces.begin(), faces.end(), lifted); one != faces.end())
      deck_.refuse(
          diagnostics_, c, "SURFB",
          fmt::format("CNTCO of *CONTROL_SHELL is not supported where SURFA has particles, and shell "
                      "{} has an offset",
                      g.id[*one]),
          "give CNTCO 0, or put the nodes into the middle");
  }
  std::vector<bool> particles_of(const ContactCard& c) {
    const Particles& p = world_.particles;
    constexpr int node_set = 4, all = 5, all_but = 6;
    std::vector<bool> out(p.size(), c.surfatyp == all);
    if (c.surfatyp == node_set) return nodes_of_set(c, std::move(out));
    std::vector<bool> chosen(model_.parts.size(), c.surfatyp == all_but);
    const int type = c.surfatyp == all_but ? 2 : c.surfatyp;
    for (const Index part : parts_named(deck_, model_, c, "SURFA", c.surfa, type, diagnostics_)) {
      chosen[part] = c.surfatyp != all_but;
      const ModelPart& named = model_.parts[part];
      if (!named.has_sph && !named.has_shell && !named.has_solid)
        deck_.error(diagnostics_, c, "SURFA", fmt::format("part {} has no elements", named.id),
                    "SURFA must be parts of particles or elements, or a node set");
    }
    for (Index i = 0; i < p.size() && c.surfatyp != all; ++i) out[i] = chosen[p.part[i]];
    return out;
  }

  /// Whether faces that deletion lays bare count.
  static bool goes_inside(const ContactCard& c) { return kind_of(c).eroding && c.erosop == 1; }
  bool is_hidden(Index segment) const {
    const Field<Index>* eroded = shared_fields::eroded.find(world_.segments.fields);
    return eroded && (*eroded)[segment] == shared_fields::hidden;
  }
  std::vector<Index> named_faces(const ContactCard& c) {
    FaceFinder finder(deck_, model_, options_.bulk_modulus, world_, diagnostics_);
    finder.with_inner(goes_inside(c));
    std::vector<Index> out = finder.faces(c, ContactSide::b);
    finder.are_stiff(c, out, c.soft != 0);
    refuse_lifted(c, out);
    return out;
  }

  std::vector<bool> nodes_of_set(const ContactCard& c, std::vector<bool> out) {
    const auto set = model_.node_sets.find(c.surfa);
    if (set == model_.node_sets.end()) {
      deck_.error(diagnostics_, c, "SURFA", fmt::format("node set {} does not exist", c.surfa),
                  "define it with *SET_NODE_LIST");
      return out;
    }
    std::unordered_set<Id> ids;
    for (const Index n : set->second) ids.insert(model_.nodes[n].id);
    std::size_t found = 0;
    for (Index i = 0; i < world_.particles.size(); ++i)
      if (ids.count(world_.particles.id[i])) {
        out[i] = true;
        ++found;
      }
    if (ids.empty()) deck_.error(diagnostics_, c, "SURFA", fmt::format("node set {} is empty", c.surfa));
    for (Index n = 0; n < world_.nodes.size(); ++n) found += ids.count(world_.nodes.id[n]);
    if (found < ids.size())
      deck_.error(diagnostics_, c, "SURFA",
                  fmt::format("{} of the {} nodes of set {} are neither particles nor nodes of elements",
                              ids.size() - found, ids.size(), c.surfa),
                  "leave them out");
    return out;
  }

  const Deck& deck_;
  const Model& model_;
  const ContactOptions& options_;
  World& world_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::vector<InterfaceLawsOf>& interface_law_registry() {
  static std::vector<InterfaceLawsOf> registry;
  return registry;
}

namespace {

ContactLaw law_of(const Deck& deck, const Model& model, const ContactCard& c, Diagnostics& diagnostics) {
  const ControlContact* control = deck.last<ControlContact>();
  ContactLaw law;
  law.id = c.cid;
  law.title = c.title;
  if (control) {
    law.slsfac = control->slsfac;
    law.penopt = control->penopt;
  }
  law.sfsa = c.sfsa, law.sfsb = c.sfsb;
  law.sast = c.sast, law.sbst = c.sbst, law.sfsat = c.sfsat, law.sfsbt = c.sfsbt;
  static_cast<FrictionLaw&>(law) = friction_of_card(deck, model, c, diagnostics);
  law.vdc = c.vdc;
  law.birth = c.bt, law.death = c.dt;
  law.soft = c.soft == 2 ? 1 : c.soft, law.sofscl = c.sofscl, law.dtstif = c.dtstif;
  for (const LiteralPenalty& card : deck.all<LiteralPenalty>())
    law.literal = law.literal || card.cid == 0 || card.cid == law.id;
  return law;
}

std::vector<AskedInterfaceLaw> interface_laws(const Deck& deck, Diagnostics& diagnostics) {
  std::vector<AskedInterfaceLaw> out;
  std::set<Id> contacts;
  for (const ContactCard& c : deck.all<ContactCard>()) contacts.insert(c.cid);
  for (const LiteralPenalty& card : deck.all<LiteralPenalty>())
    if (card.cid > 0 && !contacts.contains(card.cid))
      deck.error(diagnostics, card, "CID", fmt::format("contact {} does not exist", card.cid),
                 "give the id of a *CONTACT");
  for (const InterfaceLawsOf& laws : interface_law_registry())
    for (AskedInterfaceLaw& one : laws(deck)) {
      if (!contacts.contains(one.contact))
        deck.error(diagnostics, one.card, "", fmt::format("contact {} does not exist", one.contact),
                   "give the id of a *CONTACT");
      out.push_back(std::move(one));
    }
  return out;
}

}  // namespace

std::vector<std::shared_ptr<Contact>> build_contacts(const Deck& deck, const Model& model,
                                                     const ContactOptions& options, World& world,
                                                     Diagnostics& diagnostics) {
  std::vector<std::shared_ptr<Contact>> out;
  ParticleContactBuilder builder(deck, model, options, world, diagnostics);
  int number = 0;
  const std::vector<ContactCard>& asked = deck.all<ContactCard>();
  const std::vector<AskedInterfaceLaw> laws = interface_laws(deck, diagnostics);
  for (const ContactCard& c : asked) {
    ++number;
    const int errors = diagnostics.errors();
    if (c.fs == 2)
      deck.error(diagnostics, c, "FS", "FS = 2 asks for a friction table, which is not supported",
                 "give a coefficient other than 2");
    if (world.nodes.size() == 0) warn_of_sliding(deck, c, diagnostics);  // else contact of nodes does
    if (!kind_of(c).nodes || world.particles.size() == 0) continue;
    const std::vector<bool> tracked = builder.tracked(c);
    if (diagnostics.errors() == errors &&
        (c.surfatyp != 5 && std::find(tracked.begin(), tracked.end(), true) == tracked.end()))
      continue;
    builder.refuse_for_particles(c);
    const std::vector<Index> segments = builder.segments(c);
    if (diagnostics.errors() > errors || segments.empty()) continue;
    ContactLaw law = law_of(deck, model, c, diagnostics);
    if (SensorBoard* const board = sensors_of(deck, model, world, diagnostics))
      law.gate = board->gate_of_contact(c.cid);
    auto contact = std::make_shared<Contact>(law, options, number, segments, tracked, world);
    world.passes.add(make_particle_springs(law, number, tracked, world));
    for (const AskedInterfaceLaw& one : laws)
      if (one.contact == contact->report().id) contact->add_law(one.law);
    const Contact::Penetrations p = contact->penetrations(world);
    world.counters["initial_penetrations"] += p.count;
    if (p.count > 0)
      diagnostics.warning(
          deck.where(c),
          fmt::format("{}: {} initial penetrations, deepest {:.4g} [L] at particle {}", deck.keyword(c),
                      p.count, p.deepest, p.particle),
          "they are pushed out by the penalty force; move the particles or reduce the thickness");
    out.push_back(contact);
  }
  for (const AskedInterfaceLaw& one : laws)
    if (diagnostics.ok() && std::none_of(out.begin(), out.end(), [&](const auto& contact) {
          return contact->report().id == one.contact;
        }))
      deck.error(diagnostics, one.card, "",
                 fmt::format("contact {} has no particles, on which this law acts", one.contact),
                 "give the id of a *CONTACT whose SURFA has particles");
  return out;
}

}  // namespace courant

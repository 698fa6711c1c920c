// What contacts bring into a world.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/cards.hpp"
#include "contact/contact.hpp"
#include "contact/contact_numbers.hpp"
#include "contact/edges/build.hpp"
#include "contact/nodes/build.hpp"
#include "contact/tied/build.hpp"
#include "extension/builders.hpp"
#include "extension/part_values.hpp"
#include "loads/walls/wall_penalty.hpp"

namespace courant {

namespace {

void ask_for_inner_faces(const Deck& deck, InnerFaces& faces) {
  const std::vector<ContactCard> contacts(deck.all<ContactCard>());
  faces.wanted = std::any_of(contacts.begin(), contacts.end(),
                             [](const ContactCard& c) { return kind_of(c).eroding && c.erosop == 1; });
}

void read_wall_penalty(const Deck& deck, RigidWallPenalty& penalty) {
  if (const auto* control = deck.last<ControlContact>())
    penalty.scale = std::abs(control->rwpnal), penalty.of_all_nodes = control->rwpnal < 0;
}

void tie(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
         const BulkModuli& bulk_moduli, const WallBodies& bodies, const MassGrowth& growth, StepShare& share,
         TiedNodes&) {
  const TiedOptions options{bulk_moduli, bodies, model.tssfac, growth.in_run};
  share.value *= add_tied_contacts(deck, model, options, world, diagnostics);
}

void find_contacts_of_particles(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                                const ParticleContactRules& rules, const ParticlePressures&,
                                const BulkModuli& bulk_moduli, const WallBodies& bodies,
                                std::vector<std::shared_ptr<Contact>>& contacts) {
  if (!rules.particles) return;
  contacts = build_contacts(deck, model,
                            {.skip_inactive = rules.skip_inactive,
                             .thickness_from_volume = rules.thickness_from_volume,
                             .bulk_modulus = bulk_moduli,
                             .bodies = bodies,
                             .reach_margin = rules.reach_margin,
                             .tssfac = model.tssfac},
                            world, diagnostics);
}

void add_contacts_of_particles(World& world, LeftOut& left_out, const ParticleContactRules& rules,
                               const std::vector<std::shared_ptr<Contact>>& contacts, const FlowPasses&) {
  if (!rules.particles) return;
  for (const auto& contact : contacts) add_contact(world, contact);
  if (contacts.empty()) left_out.add("contact", "no *CONTACT");
}

void warn_of_beams_that_touch_nothing(const Deck& deck, const Model& model, const NodeContactOptions& options,
                                      Diagnostics& diagnostics) {
  const ContactCard* of_faces = nullptr;
  for (const ContactCard& c : deck.all<ContactCard>()) {
    if (kind_of(c).edges) return;
    if (!of_faces && !options.with_particles.contains(c.cid)) of_faces = &c;
  }
  if (model.beams.empty() || !of_faces) return;
  diagnostics.warning(deck.where(*of_faces),
                      fmt::format("{}: beams take no part in contact, only the shells and solids beside them",
                                  deck.keyword(*of_faces)),
                      "use *CONTACT_AUTOMATIC_GENERAL, or give what must touch faces");
}

void add_contacts_of_nodes(const Deck& deck, const Model& model, World& world, Diagnostics& diagnostics,
                           const BulkModuli& bulk_moduli, const WallBodies& bodies,
                           const std::vector<std::shared_ptr<Contact>>& contacts) {
  NodeContactOptions options{bulk_moduli, bodies, model.tssfac, {}};
  for (const auto& contact : contacts) options.with_particles.insert(contact->report().id);
  warn_of_beams_that_touch_nothing(deck, model, options, diagnostics);
  const NodeContactsByCard nodes = add_node_contacts(deck, model, options, world, diagnostics);
  add_edge_contacts(deck, model, options, nodes, world, diagnostics);
}

const RegisterBuilder numbers(BuildPhase::model, "numbers of contacts", number_contacts, Errors::go_on);
const RegisterBuilder inner(BuildPhase::parts, "faces between elements", ask_for_inner_faces, Errors::go_on);
const RegisterBuilder walls(BuildPhase::parts, "penalty of walls", read_wall_penalty, Errors::go_on);
const RegisterBuilder ties(BuildPhase::ties, "tied contacts", tie);
const RegisterBuilder find(BuildPhase::flow, "contacts of particles", find_contacts_of_particles);
const RegisterBuilder add(BuildPhase::flow, "passes of contacts of particles", add_contacts_of_particles);
const RegisterBuilder of_nodes(BuildPhase::faces, "contacts of nodes", add_contacts_of_nodes, Errors::go_on);

}  // namespace

}  // namespace courant

#include "rigid/switches/switch_cards.hpp"
#include "rigid/bodies/rigid_cards.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

using A = AutomaticSwitch;

IdSpace entry_space(const A& card) {
  return card.of_wall() ? IdSpace::rigid_wall : card.of_contact() ? IdSpace::contact : IdSpace::none;
}

constexpr FieldRules unsupported_part{.honour = unsupported.honour, .refers = IdSpace::part};

const RegisterKeyword<A> automatic_switch{
    {.names = {"DEFORMABLE_TO_RIGID_AUTOMATIC"},
     .purpose = "parts that become rigid, or deformable again, while the run goes on: at a time, or when a "
                "contact or rigid wall pushes or no longer does. A rigid part keeps its stress; its elements "
                "still bound the step",
     .many = false,
     .cards = {
         {.fields =
              {{"SWSET", &A::swset, "-", "number of the switch", rules::required_id},
               {"CODE",
                &A::code,
                "-",
                "0 at TIME1; between TIME1 and TIME2 when: 1 the rigid wall ENTNO pushes nothing, 2 the "
                "contact ENTNO does not, 3 the wall pushes, 4 the contact does",
                {.allowed = {0, 1, 2, 3, 4}}},
               {"TIME1", &A::time1, "T", "not before", {.check = Check::not_negative}},
               {"TIME2",
                &A::time2,
                "T",
                "CODE 1 to 4: not after",
                {.standard = 1e20, .zero_is_standard = true}},
               {"TIME3",
                &A::time3,
                "T",
                "for so long no other switch acts after this one",
                {.check = Check::not_negative}},
               {"ENTNO",
                &A::entno,
                "-",
                "rigid wall or contact",
                {.check = Check::not_negative},
                entry_space},
               {"RELSW",
                &A::relsw,
                "-",
                "switch that must have acted before, 0 none",
                {.check = Check::not_negative}},
               {"PAIRED",
                &A::paired,
                "-",
                "1: acts first and again after each time that RELSW did, -1: acts after RELSW did; 0: once",
                {.allowed = {0, 1, -1}}}}},
         {.fields =
              {
                  {"NRBF", &A::nrbf, "-", "deletes or activates rigid bodies of nodes", unsupported},
                  {"NCSF", &A::ncsf, "-", "deletes or activates node sets that move alike", unsupported},
                  {"RWF", &A::rwf, "-", "deletes or activates rigid walls", unsupported},
                  {"DTMAX",
                   &A::dtmax,
                   "T",
                   "longest step from then on, 0 none",
                   {.check = Check::not_negative}},
                  {"D2R", &A::d2r, "-", "number of parts that become rigid", {.check = Check::not_negative}},
                  {"R2D",
                   &A::r2d,
                   "-",
                   "number of parts that become deformable",
                   {.check = Check::not_negative}},
                  {"OFFSET", &A::offset, "L", "distance from a contact or wall that counts as touching it",
                   unsupported}}},
         {.fields = {{"PID", &A::pid, "-", "part, or set of parts, that becomes rigid",
                      rules::id_of(IdSpace::part)},
                     {"LRB", &A::lrb, "-", "part of the same list with which it is one body, 0 none",
                      rules::id_of(IdSpace::part)},
                     {"PTYPE", &A::ptype, "-", "PART or blank; PSET: PID is a set"}},
          .repeat = true,
          .more = [](const A& card) { return static_cast<int>(card.pid.size()) < card.d2r; }},
         {.fields = {{"PID", &A::soft_pid, "-", "part, or set of parts, that becomes deformable",
                      rules::id_of(IdSpace::part)},
                     {"PTYPE", &A::soft_ptype, "-", "PART or blank; PSET: PID is a set"}},
          .repeat = true,
          .more = [](const A& card) { return static_cast<int>(card.soft_pid.size()) < card.r2d; }},
         {.fields = {{"PID", &A::spare_pid, "-", "no more parts than D2R and R2D say", unsupported_part},
                     {"LRB", &A::spare_lrb, "-", "of none", no_effect},
                     {"PTYPE", &A::spare_ptype, "-", "of none", no_effect}},
          .optional = true,
          .repeat = true}}}};

using D2R = ToRigidAtRestart;
using R2D = ToDeformableAtRestart;
using C = ControlAtRestart;

const RegisterKeyword<D2R> to_rigid_at_restart{rigid_deformable_d2r_table()};
const RegisterKeyword<R2D> to_deformable_at_restart{rigid_deformable_r2d_table()};
const RegisterKeyword<C> control_at_restart{rigid_deformable_control_table()};

std::vector<Index> parts_of(const Deck& deck, const Model& model, const Entry& card, const char* field, Id id,
                            const std::string& type, Diagnostics& diagnostics) {
  const auto refuse = [&](std::string message, const char* hint) {
    deck.error(diagnostics, card, field, std::move(message), hint);
    return std::vector<Index>();
  };
  if (type == "PSET") {
    const auto set = model.part_sets.find(id);
    return set == model.part_sets.end()
               ? refuse(fmt::format("part set {} does not exist", id), "define it with *SET_PART")
               : set->second;
  }
  if (!type.empty() && type != "PART")
    return refuse(fmt::format("PTYPE '{}' is not supported", type), "PART or PSET");
  const auto part = model.part_of_id.find(id);
  if (part == model.part_of_id.end())
    return refuse(fmt::format("part {} does not exist", id), "define it with *PART");
  return {part->second};
}

}  // namespace

std::vector<PartAndLead> parts_to_rigid(const Deck& deck, const Model& model, const A& card,
                                        Diagnostics& diagnostics) {
  std::vector<PartAndLead> out;
  for (std::size_t k = 0; k < card.pid.size(); ++k)
    for (const Index part :
         parts_of(deck, model, card, card.d2r_field, card.pid[k], card.ptype[k], diagnostics))
      out.push_back({part, card.lrb[k]});
  return out;
}

std::vector<Index> parts_to_deformable(const Deck& deck, const Model& model, const A& card,
                                       Diagnostics& diagnostics) {
  std::vector<Index> out;
  for (std::size_t k = 0; k < card.soft_pid.size(); ++k)
    for (const Index part :
         parts_of(deck, model, card, card.r2d_field, card.soft_pid[k], card.soft_ptype[k], diagnostics))
      out.push_back(part);
  return out;
}

std::vector<AutomaticSwitch> switches_at_restart(const Deck& deck) {
  std::vector<A> out;
  const auto begin = [&](const Entry& card, const char* name, const char* field) -> A& {
    if (out.empty() || out.back().at_restart != name) {
      A& one = out.emplace_back();
      static_cast<Entry&>(one) = card;
      one.at_restart = name, one.first_field = one.d2r_field = one.r2d_field = field;
    }
    return out.back();
  };
  for (const R2D& card : deck.all<R2D>()) {
    A& one = begin(card, "R2D", "PID");
    one.soft_pid.push_back(card.pid), one.soft_ptype.emplace_back(), ++one.r2d;
  }
  for (const D2R& card : deck.all<D2R>()) {
    A& one = begin(card, "D2R", "PID");
    one.pid.push_back(card.pid), one.lrb.push_back(card.lrb), one.ptype.emplace_back(), ++one.d2r;
  }
  for (const C& card : deck.all<C>()) begin(card, "CONTROL", "DTMAX").dtmax = card.dtmax;
  return out;
}

void warn_of_switch_at_restart(const Deck& deck, Diagnostics& diagnostics) {
  if (const auto cards = switches_at_restart(deck); !cards.empty())
    deck.warning(
        diagnostics, cards.front(), cards.front().first_field,
        "parts are switched when a run goes on from a restart file; this one starts from the beginning",
        "run the deck with --restart, or switch parts by *DEFORMABLE_TO_RIGID_AUTOMATIC");
}

bool is_released(const Deck& deck, const Model& model, Index part) {
  Diagnostics told_elsewhere;
  for (const A& card : deck.all<A>()) {
    const std::vector<Index> soft = parts_to_deformable(deck, model, card, told_elsewhere);
    if (std::find(soft.begin(), soft.end(), part) != soft.end()) return true;
  }
  return false;
}

}  // namespace courant

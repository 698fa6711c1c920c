// Tables of the histories: which, how often, of whom.
#include "keyword/registry.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

const FieldRules optional_id{.check = Check::not_negative};

using A = DatabaseAsciiCard;
const RegisterKeyword<A> database_ascii{
    {.names = {"DATABASE_GLSTAT", "DATABASE_MATSUM", "DATABASE_RCFORC", "DATABASE_SPHOUT", "DATABASE_SLEOUT",
               "DATABASE_NODOUT", "DATABASE_RBDOUT", "DATABASE_BNDOUT", "DATABASE_SPCFORC",
               "DATABASE_RWFORC"},
     .purpose = "interval of a history: energies, parts, contacts, particles, nodes, rigid bodies, "
                "prescribed motions, supports, rigid walls",
     .once = true,
     .many = false,
     .cards = {{.fields = {{"DT", &A::dt, "T", "interval, 0 none"},
                           {"BINARY", &A::binary, "-", "kind of file: always text and history.h5", no_effect},
                           {"LCUR",
                            &A::lcur,
                            "-",
                            "curve of the interval, instead of DT",
                            {.check = Check::not_negative, .refers = IdSpace::curve}},
                           {"IOOPT",
                            &A::ioopt,
                            "-",
                            "1 next at t + f(t), 2 f at the next, 3 at the abscissae",
                            {.standard = 1, .allowed = {1, 2, 3}}},
                           {"OPTION1", &A::option1, "-", "option of some", no_output},
                           {"OPTION2", &A::option2, "-", "option of some", no_effect},
                           {"OPTION3", &A::option3, "-", "option of some", no_effect},
                           {"OPTION4", &A::option4, "-", "option of some", no_effect}}}}}};

using H = DatabaseHistorySphCard;
const RegisterKeyword<H> database_history_sph{
    {.names = {"DATABASE_HISTORY_SPH", "DATABASE_HISTORY_SPH_SET"},
     .purpose = "particles whose histories go to sphout (_SET: node sets)",
     .cards = {
         {.fields = {{"ID", &H::ids, "-", "ids of particles, or of node sets", optional_id,
                      [](const H& card) { return card.name == 1 ? IdSpace::node_set : IdSpace::node; }}},
          .repeat = true}}}};

using N = DatabaseHistoryNodeCard;
const RegisterKeyword<N> database_history_node{
    {.names = {"DATABASE_HISTORY_NODE", "DATABASE_HISTORY_NODE_SET"},
     .purpose = "nodes and particles whose histories go to nodout (_SET: node sets)",
     .cards = {
         {.fields = {{"ID", &N::ids, "-", "ids of nodes, or of node sets", optional_id,
                      [](const N& card) { return card.name == 1 ? IdSpace::node_set : IdSpace::node; }}},
          .repeat = true}}}};

using I = DatabaseHistoryNodeIdCard;
const RegisterKeyword<I> database_history_node_id{
    {.names = {"DATABASE_HISTORY_NODE_ID"},
     .purpose = "nodes and particles whose histories go to nodout, with headings for its legend",
     .cards = {
         {.fields =
              {{"ID", &I::ids, "-", "id of a node", {.check = Check::not_negative, .refers = IdSpace::node}},
               {"HEADING", &I::headings, "-", "its name", {.width = 70}}},
          .repeat = true}}}};

}  // namespace

}  // namespace courant

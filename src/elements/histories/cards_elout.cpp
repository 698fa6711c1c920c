// Tables of *DATABASE_ELOUT, of the elements it tells of, and of *CONTROL_OUTPUT.
#include "elements/histories/cards_elout.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

constexpr IdSpace element_spaces[] = {IdSpace::solid, IdSpace::beam, IdSpace::shell};
constexpr IdSpace element_set_spaces[] = {IdSpace::solid_set, IdSpace::beam_set, IdSpace::shell_set};
constexpr FieldRules listed_id{.check = Check::not_negative};

using H = HistoryElements;
const RegisterKeyword<H> database_history_elements{
    {.names = {"DATABASE_HISTORY_SOLID", "DATABASE_HISTORY_SOLID_SET", "DATABASE_HISTORY_BEAM",
               "DATABASE_HISTORY_BEAM_SET", "DATABASE_HISTORY_SHELL", "DATABASE_HISTORY_SHELL_SET"},
     .purpose = "elements whose histories go to elout (_SET: sets of them)",
     .cards = {{.fields = {{"ID", &H::ids, "-", "ids of elements, or of sets of elements", listed_id,
                            [](const H& card) {
                              const auto kind = static_cast<std::size_t>(card.kind());
                              return card.sets() ? element_set_spaces[kind] : element_spaces[kind];
                            }}},
                .repeat = true}}}};

using I = HistoryElementIds;
const RegisterKeyword<I> database_history_element_ids{
    {.names = {"DATABASE_HISTORY_SOLID_ID", "DATABASE_HISTORY_BEAM_ID", "DATABASE_HISTORY_SHELL_ID"},
     .purpose = "elements whose histories go to elout, with headings for its legend",
     .cards = {
         {.fields = {{"ID", &I::ids, "-", "id of an element", listed_id,
                      [](const I& card) { return element_spaces[static_cast<std::size_t>(card.kind())]; }},
                     {"HEADING", &I::headings, "-", "its name", {.width = 70}}},
          .repeat = true}}}};

KeywordOf<DatabaseElout> database_elout_table() {
  using T = DatabaseElout;
  auto out = history_interval<T>(
      "DATABASE_ELOUT",
      "interval of elout: stress at the points of solids, shells and beams, resultants of beams");
  auto& fields = out.cards.front().fields;
  const FieldRules count{.check = Check::not_negative};
  fields.push_back({"OPTION1", &T::solids, "-", "history variables of solids to print", count});
  fields.push_back({"OPTION2", &T::shells, "-", "history variables of shells to print", count});
  fields.push_back({"OPTION3", &T::thick_shells, "-", "of thick shells, which are not there", no_output});
  fields.push_back({"OPTION4", &T::beams, "-", "history variables of beams to print", count});
  return out;
}
const RegisterKeyword<DatabaseElout> database_elout{database_elout_table()};

KeywordOf<ControlOutput> control_output_table() {
  using T = ControlOutput;
  using Fields = std::vector<FieldOf<T>>;
  const auto idle = [](const char* name, const char* meaning, Real standard = 0) {
    return FieldOf<T>{name, &T::unused, "-", meaning, no_effect_but(standard)};
  };
  const auto idle_real = [](const char* name, const char* meaning, Real standard = 0) {
    return FieldOf<T>{name, &T::unused_real, "-", meaning, no_effect_but(standard)};
  };
  Fields first{idle("NPOPT", "1 suppress nodes, elements in d3hsp"),
               idle("NEECHO", "echo-file suppression 0-3"),
               idle("NREFUP", "beam reference node update"),
               idle("IACCOP", "nodout accelerations 0 raw 1 averaged 2 filtered"),
               idle_real("OPIFS", "interface-file interval"),
               idle("IPNINT", "time steps listed on cycle 1 (0 -> 100 smallest)"),
               idle("IKEDIT", "cycles between status reports in d3hsp", 100),
               idle("IFLUSH", "cycles between buffer flushes", 5000)};
  Fields second{idle("IPRTF", "which of rbdout/matsum hold part data"),
                idle("IERODE", "1 eroded energies in matsum"),
                idle("TET10S8", "higher-order connectivity in d3plot", 2),
                idle("MSGMAX", "messages of each kind printed", 50),
                idle("IPCURV", "1 print digitised curves"),
                idle_real("GMDT", "interface motion interval"),
                idle("IP1DBLT", "belt output"),
                {"EOCS", &T::eocs, "-", "axes of stress of shells in elout: 0, 2 global, 1 local",
                 FieldRules{.allowed = {0, 1, 2}}}};
  Fields third{idle("TOLEV", "timing summary levels", 2),
               idle("NEWLEG", "legend format"),
               idle("FRFREQ", "failed-element report interval", 1),
               idle("MINFO", "mortar contact information"),
               idle("SOLSIG", "stress extrapolation to nodes"),
               idle("MSGFLG", "long messages to d3msg"),
               idle_real("CDETOL", "curve discretisation warning tolerance, percent", 10),
               idle("IGEOM", "d3plot nodes: 1 coordinates 2 displacements", 1)};
  Fields fourth{
      idle("PHSCHNG", "phase change message"),     idle("DEMDEN", "DEM density output"),
      idle("ICRFILE", "section set output"),       idle("SPC2BND", "rigid constraints as bndout motions"),
      idle("PENOUT", "mortar penetration output"), idle("SHLSIG", "stress extrapolation to nodes"),
      idle("HISNOUT", "history variable names"),   idle("ENGOUT", "contact energy density output")};
  Fields fifth;
  for (const char* name : {"INSF", "ISOLSF", "IBSF", "ISSF"})
    fifth.push_back(idle(name, "write generated sets to file"));
  fifth.push_back(idle("MLKBAG", "airbag leakage output"));
  fifth.push_back(idle("KINENG", "kinetic energy density field"));
  fifth.push_back(idle("ISFCNT", "interface linking continuity", 1));
  Fields sixth;
  for (const char* name : {"IELOGKEY", "IELOGINI", "IELOGSOL"})
    sixth.push_back(idle(name, "error.log level per phase"));
  KeywordOf<T> out{
      .names = {"CONTROL_OUTPUT"}, .purpose = "printed output: axes of elout", .once = true, .many = false};
  out.cards.push_back({.fields = first});
  for (Fields* fields : {&second, &third, &fourth, &fifth, &sixth})
    out.cards.push_back({.fields = *fields, .optional = true});
  return out;
}
const RegisterKeyword<ControlOutput> control_output{control_output_table()};

}  // namespace

}  // namespace courant

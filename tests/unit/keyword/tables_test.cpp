// What *INCLUDE_TRANSFORM needs of every keyword's table: what ids number, dimensions, what moves.
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "keyword/registry.hpp"
#include "model/transforms/included_entries.hpp"

namespace courant {

namespace {

/// Fields of type Id that number nothing, each with the reason.
const std::map<std::string, const char*> plain_numbers = {
    {"INITIAL_STRESS_SECTION ISSID", "nothing refers to it"},
    {"INITIAL_STRESS_SECTION CSID", "sections have no ids of their own kind"},
    {"INCLUDE_TRANSFORM IDNOFF", "an offset"},
    {"INCLUDE_TRANSFORM IDEOFF", "an offset"},
    {"INCLUDE_TRANSFORM IDPOFF", "an offset"},
    {"INCLUDE_TRANSFORM IDMOFF", "an offset"},
    {"INCLUDE_TRANSFORM IDSOFF", "an offset"},
    {"INCLUDE_TRANSFORM IDFOFF", "an offset"},
    {"INCLUDE_TRANSFORM IDDOFF", "an offset"},
    {"INCLUDE_TRANSFORM IDROFF", "an offset"},
    {"COURANT_LITERAL_PENALTY CID", "an id, or a number among contacts without"},
    {"CONSTRAINED_LINEAR_GLOBAL LICD", "a number that nothing refers to"},
    {"CONSTRAINED_LINEAR_GLOBAL DOF", "a degree of freedom"},
    {"CONSTRAINED_LINEAR_LOCAL LICD", "a number that nothing refers to"},
    {"CONSTRAINED_LINEAR_LOCAL DOF", "a degree of freedom"},
    {"DEFINE_FRICTION ID", "FD of contacts"},
    {"COURANT_GAUGE_POINT GID", "a number among gauges"},
    {"COURANT_GAUGE_LEVEL GID", "a number among gauges"},
    {"COURANT_GAUGE_RUNUP GID", "a number among gauges"},
    {"COURANT_GAUGE_FLUX GID", "a number among gauges"},
    {"COURANT_GAUGE_FORCE GID", "a number among gauges"},
    {"CONSTRAINED_INTERPOLATION ICID", "a number among interpolations"},
    {"CONSTRAINED_INTERPOLATION IDOF", "digits of degrees of freedom"},
    {"CONTROL_TERMINATION ENDCYC", "a number of steps, which may be large"},
    {"ELEMENT_SEATBELT_ACCELEROMETER SBACID", "a number among accelerometers"},
    {"DEFORMABLE_TO_RIGID_AUTOMATIC SWSET", "a number among switches"},
    {"DEFORMABLE_TO_RIGID_AUTOMATIC ENTNO", "of a wall or a contact, by CODE"},
    {"DEFORMABLE_TO_RIGID_AUTOMATIC RELSW", "a number among switches"},
    {"INTEGRATION_BEAM IRID", "a number among rules"},
    {"INTEGRATION_SHELL IRID", "a number among rules"},
    {"LOAD_BLAST_ENHANCED BID", "a number among charges"},
    {"LOAD_BLAST_SEGMENT BID", "a number among charges"},
    {"LOAD_BLAST_SEGMENT_SET BID", "a number among charges"},
    {"PART_COMPOSITE PLYID", "a name"},
    {"ELEMENT_SHELL_COMPOSITE PLYID", "a name"},
    {"SENSOR_DEFINE_FORCE TYPEID", "of what exerts it"},
    {"SENSOR_DEFINE_MISC SENSID", "a number among sensors"},
    {"SENSOR_DEFINE_CALC-MATH SENSID", "a number among sensors"},
    {"SENSOR_DEFINE_CALC-MATH SENS1", "a number among sensors"},
    {"SENSOR_DEFINE_CALC-MATH SENS2", "a number among sensors"},
    {"SENSOR_DEFINE_CALC-MATH SENS3", "a number among sensors"},
    {"SENSOR_DEFINE_CALC-MATH SENS4", "a number among sensors"},
    {"SENSOR_DEFINE_CALC-MATH SENS5", "a number among sensors"},
    {"SENSOR_DEFINE_CALC-MATH SENS6", "a number among sensors"},
    {"SENSOR_SWITCH FILTRID", "of a filter, which there is none of"},
    {"SENSOR_CONTROL CNTLID", "a number among sensors"},
    {"SENSOR_CONTROL SWIT1", "a number among sensors"},
    {"SENSOR_CONTROL SWIT2", "a number among sensors"},
    {"SENSOR_CONTROL SWIT3", "a number among sensors"},
    {"SENSOR_CONTROL SWIT4", "a number among sensors"},
    {"SENSOR_CONTROL SWIT5", "a number among sensors"},
    {"SENSOR_CONTROL SWIT6", "a number among sensors"},
    {"SENSOR_CONTROL SWIT7", "a number among sensors"},
    {"SENSOR_DEFINE_ELEMENT SENSID", "a number among sensors"},
    {"SENSOR_DEFINE_FORCE SENSID", "a number among sensors"},
    {"SENSOR_DEFINE_NODE SENSID", "a number among sensors"},
    {"SENSOR_SWITCH SENSID", "a number among sensors"},
    {"SENSOR_SWITCH SWITID", "a number among sensors"},
    {"TERMINATION_SENSOR SWID", "a number among sensors"},
};

/// Columns whose ids depend on the word or the number beside them in the row: KeywordOf::convert shifts them.
bool depends_on_row(const KeywordSpec& spec, const FieldSpec& field) {
  const std::string& name = spec.names[0];
  const auto ends = [&](const std::string& end) {
    return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
  };
  return (ends("_GENERAL") && field.name[0] == 'E') || ends("_ADD_ADVANCED") ||
         (ends("_GENERATE_INCREMENT") && field.name == "INCR");  // the last one numbers nothing
}

/// Curves whose dimensions nobody needs to know: their fields are refused or without effect. Others are in
/// curve_units.cpp.
bool has_effect(const FieldSpec& field) {
  return field.rules.honour == Honour::yes;
}

std::string full_name_of(const KeywordSpec& spec, const FieldSpec& field) {
  return spec.names[0] + " " + std::string(field.name);
}

/// "M/LT2", "1/T", "L3", "-"
bool is_dimension(std::string_view text) {
  if (text == "-" || text == "1") return true;
  bool divided = false, any = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '/' && !divided && any)
      divided = true;
    else if (c == '1' && i == 0 && text.size() > 2 && text[1] == '/')
      any = true;
    else if (c == 'M' || c == 'L' || c == 'T')
      any = true;
    else if (!(c >= '2' && c <= '9' && i > 0 && std::isalpha(static_cast<unsigned char>(text[i - 1]))))
      return false;
  }
  return any && text.back() != '/';
}

/// Calls `visit` for every field of every table with an entry of that table.
void for_each_field(
    const std::function<void(const KeywordSpec&, std::size_t card, std::size_t field)>& visit) {
  for (const auto& spec : keyword_registry())
    for (std::size_t c = 0; c < spec->cards.size(); ++c)
      for (std::size_t f = 0; f < spec->cards[c].fields.size(); ++f) visit(*spec, c, f);
}

/// The locations of fields for which a table states what their ids number, of a blank entry.
std::set<std::pair<std::size_t, std::size_t>> told(const KeywordSpec& spec) {
  Deck deck;
  const auto sink = spec.sink(deck);
  Entry where;
  where.keyword = 0;
  sink->begin(where);
  for (std::size_t c = 0; c < spec.cards.size(); ++c)
    for (std::size_t f = 0; f < spec.cards[c].fields.size(); ++f)
      if (spec.cards[c].fields[f].type == FieldType::ids) sink->set_integer(c, f, 1);
  std::set<std::pair<std::size_t, std::size_t>> out;
  spec.for_each_id(sink->entry(), [&](const IdUse& use) { out.insert({use.card, use.field}); });
  return out;
}

}  // namespace

TEST(Tables, TellWhatIdsNumber) {
  for (const auto& spec : keyword_registry()) {
    const auto known = told(*spec);
    for (std::size_t c = 0; c < spec->cards.size(); ++c)
      for (std::size_t f = 0; f < spec->cards[c].fields.size(); ++f) {
        const FieldSpec& field = spec->cards[c].fields[f];
        if (field.type != FieldType::id && field.type != FieldType::ids) continue;
        const std::string name = full_name_of(*spec, field);
        if (depends_on_row(*spec, field)) continue;
        EXPECT_EQ(known.count({c, f}) + plain_numbers.count(name), 1u)
            << name << ": give the field `refers` (or the keyword an id_space), or list it above";
      }
  }
}

TEST(Tables, TellDimensionsThatCanBeConverted) {
  for_each_field([](const KeywordSpec& spec, std::size_t c, std::size_t f) {
    const FieldSpec& field = spec.cards[c].fields[f];
    if (field.type == FieldType::skip) return;
    EXPECT_TRUE(is_dimension(field.dimension)) << full_name_of(spec, field) << ": " << field.dimension;
    const bool number = field.type == FieldType::real || field.type == FieldType::reals;
    if (!number) EXPECT_EQ(field.dimension, "-") << full_name_of(spec, field) << " is no real number";
    // a standard value is not converted: it must be "none" or "never"
    constexpr Real never = 1e15;
    if (number && field.dimension != "-" && spec.lacking.empty())
      EXPECT_TRUE(field.rules.standard == 0 || std::abs(field.rules.standard) >= never)
          << full_name_of(spec, field);
  });
}

TEST(Tables, TellPlacesAsThreeLengthsInARow) {
  int count = 0;
  for_each_field([&](const KeywordSpec& spec, std::size_t c, std::size_t f) {
    const auto& fields = spec.cards[c].fields;
    if (fields[f].rules.spatial == Spatial::none) return;
    ++count;
    ASSERT_LT(f + 2, fields.size()) << full_name_of(spec, fields[f]);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(fields[f + k].type, FieldType::real) << full_name_of(spec, fields[f + k]);
      if (fields[f].rules.spatial == Spatial::point) EXPECT_EQ(fields[f + k].dimension, "L");
    }
  });
  EXPECT_GE(count, 3);
}

TEST(Tables, DimensionsOfCurvesAreKnown) {
  for_each_field([](const KeywordSpec& spec, std::size_t c, std::size_t f) {
    const FieldSpec& field = spec.cards[c].fields[f];
    if (field.rules.refers != IdSpace::curve || !has_effect(field) || !spec.lacking.empty()) return;
    if (spec.names[0].rfind("DEFINE_TABLE", 0) == 0) return;  // refused in a file with unit factors
    if (field.curve_of) return;                               // other fields decide
    ASSERT_TRUE(field.rules.curve.known()) << full_name_of(spec, field) << ": say it beside the field";
    EXPECT_TRUE(is_dimension(field.rules.curve.abscissa) && is_dimension(field.rules.curve.ordinate));
  });
}

TEST(Conversion, TakesPowersFromDimensions) {
  const UnitFactors mm_t_s{.mass = 1e3, .time = 1, .length = 1e-3};
  EXPECT_DOUBLE_EQ(mm_t_s.of("-"), 1);
  EXPECT_DOUBLE_EQ(mm_t_s.of("M/L3"), 1e12);
  EXPECT_DOUBLE_EQ(mm_t_s.of("M/LT2"), 1e6);
  const UnitFactors odd{.mass = 2, .time = 3, .length = 5};
  EXPECT_DOUBLE_EQ(odd.of("M/LT"), 2.0 / 15);
  EXPECT_DOUBLE_EQ(odd.of("1/T"), 1.0 / 3);
  EXPECT_DOUBLE_EQ(odd.of("L/T2"), 5.0 / 9);
  EXPECT_DOUBLE_EQ(odd.of("T/L"), 3.0 / 5);
}

TEST(Conversion, ShiftsIdsByWhatTheyNumber) {
  const IdOffsets o{.node = 1,
                    .element = 20,
                    .part = 300,
                    .material = 4000,
                    .set = 50000,
                    .curve = 600000,
                    .definition = 7000000,
                    .other = 80000000};
  EXPECT_EQ(o.shifted(IdSpace::node, 5), 6);
  EXPECT_EQ(o.shifted(IdSpace::shell, 5), 25);
  EXPECT_EQ(o.shifted(IdSpace::part, 5), 305);
  EXPECT_EQ(o.shifted(IdSpace::rigid_wall, 5), 305);
  EXPECT_EQ(o.shifted(IdSpace::material, 5), 4005);
  EXPECT_EQ(o.shifted(IdSpace::eos, 5), 4005);
  EXPECT_EQ(o.shifted(IdSpace::segment_set, 5), 50005);
  EXPECT_EQ(o.shifted(IdSpace::curve, 5), 600005);
  EXPECT_EQ(o.shifted(IdSpace::transformation, 5), 7000005);
  EXPECT_EQ(o.shifted(IdSpace::box, 5), 7000005);
  EXPECT_EQ(o.shifted(IdSpace::section, 5), 80000005);
  EXPECT_EQ(o.shifted(IdSpace::none, 5), 5);
  EXPECT_EQ(o.shifted(IdSpace::node, 0), 0);
  EXPECT_EQ(o.shifted(IdSpace::curve, -5), -600005);  // a flag, not a number below 0
  EXPECT_GT(o.shifted(IdSpace::node, std::numeric_limits<Id>::max()), 0);
}

}  // namespace courant

// Unit factors of curves in files that *INCLUDE_TRANSFORM reads.
#include <fmt/format.h>
#include <cstdlib>
#include <map>

#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/transforms/included_entries.hpp"

namespace courant {

namespace {

constexpr CurveDimensions known[] = {
    {"LOAD_BODY_X", "LCID", "T", "L/T2"},
    {"LOAD_BODY_X", "LCIDDR", "T", "L/T2"},
    {"LOAD_BODY_VECTOR", "LCID", "T", "L/T2"},
    {"LOAD_BODY_VECTOR", "LCIDDR", "T", "L/T2"},
    {"LOAD_BODY_RX", "LCID", "T", "1/T"},
    {"LOAD_BODY_RX", "LCIDDR", "T", "1/T"},
    {"LOAD_GRAVITY_PART", "LC", "T", "-"},
    {"LOAD_GRAVITY_PART", "LCDR", "T", "-"},
    {"LOAD_NODE_POINT", "LCID", "T", "ML/T2"},
    {"LOAD_BEAM_ELEMENT", "LCID", "T", "M/T2"},
    {"LOAD_NODE_SET", "LCID", "T", "ML/T2"},
    {"LOAD_RIGID_BODY", "LCID", "T", "ML/T2"},
    {"LOAD_SEGMENT", "LCID", "T", "M/LT2"},
    {"LOAD_SEGMENT_SET", "LCID", "T", "M/LT2"},
    {"LOAD_SHELL_ELEMENT", "LCID", "T", "M/LT2"},
    {"DAMPING_GLOBAL", "LCID", "T", "1/T"},
    {"DAMPING_PART_MASS", "LCID", "T", "1/T"},
    {"CONTROL_TIMESTEP", "LCTM", "T", "T"},
    {"DATABASE_BINARY_D3PLOT", "LCDT", "T", "T"},
    {"DATABASE_GLSTAT", "LCUR", "T", "T"},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", "LCSS", "-", "M/LT2"},
    {"MAT_PIECEWISE_LINEAR_PLASTICITY", "LCSR", "1/T", "-"},
    {"MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY", "LCSS", "-", "M/LT2"},
    {"MAT_MODIFIED_PIECEWISE_LINEAR_PLASTICITY", "LCSR", "1/T", "-"},
    {"EOS_TABULATED", "LCC", "-", "M/LT2"},
    {"EOS_TABULATED", "LCT", "-", "-"},
    {"EOS_TABULATED_COMPACTION", "LCC", "-", "M/LT2"},
    {"EOS_TABULATED_COMPACTION", "LCT", "-", "-"},
    {"EOS_TABULATED_COMPACTION", "LCK", "-", "M/LT2"},
    {"MAT_CABLE_DISCRETE_BEAM", "LCID", "-", "M/LT2"},
    {"MAT_FU_CHANG_FOAM", "TBID", "-", "M/LT2"},
    {"MAT_FABRIC", "LCA", "-", "M/LT2"},
    {"MAT_FABRIC", "LCB", "-", "M/LT2"},
    {"MAT_FABRIC", "LCAB", "-", "M/LT2"},
    {"MAT_FABRIC", "LCUA", "-", "M/LT2"},
    {"MAT_FABRIC", "LCUB", "-", "M/LT2"},
    {"MAT_FABRIC", "LCUAB", "-", "M/LT2"},
    {"MAT_HONEYCOMB", "LCA", "-", "M/LT2"},
    {"MAT_HONEYCOMB", "LCB", "-", "M/LT2"},
    {"MAT_HONEYCOMB", "LCC", "-", "M/LT2"},
    {"MAT_HONEYCOMB", "LCS", "-", "M/LT2"},
    {"MAT_HONEYCOMB", "LCAB", "-", "M/LT2"},
    {"MAT_HONEYCOMB", "LCBC", "-", "M/LT2"},
    {"MAT_HONEYCOMB", "LCCA", "-", "M/LT2"},
    {"MAT_HONEYCOMB", "LCSR", "1/T", "-"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDTR", "L", "ML/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDTS", "L", "ML/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDTT", "L", "ML/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDRR", "-", "ML2/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDRS", "-", "ML2/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDRT", "-", "ML2/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDTDR", "L/T", "ML/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDTDS", "L/T", "ML/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDTDT", "L/T", "ML/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDRDR", "1/T", "ML2/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDRDS", "1/T", "ML2/T2"},
    {"MAT_NONLINEAR_ELASTIC_DISCRETE_BEAM", "LCIDRDT", "1/T", "ML2/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTR", "L", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTUR", "L", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTDR", "L/T", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTER", "L", "-"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTS", "L", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTUS", "L", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTDS", "L/T", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTES", "L", "-"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTT", "L", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTUT", "L", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTDT", "L/T", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDTET", "L", "-"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRR", "-", "ML2/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRUR", "-", "ML2/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRDR", "1/T", "ML2/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRER", "-", "-"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRS", "-", "ML2/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRUS", "-", "ML2/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRDS", "1/T", "ML2/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRES", "-", "-"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRT", "-", "ML2/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRUT", "-", "ML2/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRDT", "1/T", "ML2/T2"},
    {"MAT_GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM", "LCIDRET", "-", "-"},
    {"MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM", "LCIDT", "L", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM", "LCIDTU", "L", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM", "LCIDTD", "L/T", "ML/T2"},
    {"MAT_GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM", "LCIDTE", "L", "-"},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "LCPDR", "L", "ML/T2"},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "LCPDS", "L", "ML/T2"},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "LCPDT", "L", "ML/T2"},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "LCPMR", "-", "ML2/T2"},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "LCPMS", "-", "ML2/T2"},
    {"MAT_NONLINEAR_PLASTIC_DISCRETE_BEAM", "LCPMT", "-", "ML2/T2"},
    {"MAT_CRUSHABLE_FOAM", "LCID", "-", "M/LT2"},
    {"MAT_LOW_DENSITY_FOAM", "LCID", "-", "M/LT2"},
    {"MAT_SIMPLIFIED_RUBBER/FOAM", "LC/TBID", "L", "ML/T2"},
    {"MAT_ENHANCED_COMPOSITE_DAMAGE", "LCXC", "1/T", "M/LT2"},
    {"MAT_ENHANCED_COMPOSITE_DAMAGE", "LCXT", "1/T", "M/LT2"},
    {"MAT_ENHANCED_COMPOSITE_DAMAGE", "LCYC", "1/T", "M/LT2"},
    {"MAT_ENHANCED_COMPOSITE_DAMAGE", "LCYT", "1/T", "M/LT2"},
    {"MAT_ENHANCED_COMPOSITE_DAMAGE", "LCSC", "1/T", "M/LT2"},
    {"MAT_SPRING_NONLINEAR_ELASTIC", "LCD", "L", "ML/T2"},  // torsional ones are refused beside unit factors
    {"MAT_SPRING_NONLINEAR_ELASTIC", "LCR", "L/T", "-"},
    {"MAT_DAMPER_NONLINEAR_VISCOUS", "LCDR", "L/T", "ML/T2"},
    // VAD 0; of the others `of_entry_itself` tells, and of moments
    {"BOUNDARY_PRESCRIBED_MOTION_NODE", "LCID", "T", "L/T"},
    {"BOUNDARY_PRESCRIBED_MOTION_SET", "LCID", "T", "L/T"},
    {"BOUNDARY_PRESCRIBED_MOTION_RIGID", "LCID", "T", "L/T"},
    {"BOUNDARY_PRESCRIBED_MOTION_RIGID_LOCAL", "LCID", "T", "L/T"},
    {"RIGIDWALL_GEOMETRIC_FLAT", "LCID", "T", "L/T"},  // OPT 0
    {"DEFINE_SPH_INJECTION", "VMAG", "T", "-"},
    {"COURANT_INFLOW", "LCLEV", "T", "L"},
    {"COURANT_INFLOW", "LCPROF", "L", "-"},
    {"COURANT_LEVEL_OUTLET", "LCLEV", "T", "-"},
    {"COURANT_WALL_BELT", "LCID", "T", "-"},
    {"COURANT_FROZEN_OUTLET", "LCVEL", "T", "-"},
    {"COURANT_FROZEN_OUTLET", "LCLEV", "T", "L"},
    {"CONSTRAINED_JOINT_SPHERICAL", "LCID", "T", "1/T"},  // of motors, TYPE 0
    {"CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", "LCIDPH", "-", "ML2/T2"},
    {"CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", "LCIDT", "-", "ML2/T2"},
    {"CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", "LCIDPS", "-", "ML2/T2"},
    {"CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", "DLCIDPH", "1/T", "ML2/T2"},
    {"CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", "DLCIDT", "1/T", "ML2/T2"},
    {"CONSTRAINED_JOINT_STIFFNESS_GENERALIZED", "DLCIDPS", "1/T", "ML2/T2"},
};

/// Values by VAD and by what DOF drives: a translation, a rotation.
constexpr const char* motion_values[3][2] = {{"L/T", "1/T"}, {"L/T2", "1/T2"}, {"L", "-"}};

/// The ordinate's dimension where it depends on other fields of the entry, else nothing.
const char* of_entry_itself(const KeywordSpec& spec, const Entry& entry) {
  constexpr std::size_t dof_field = 1, vad_field = 2;
  constexpr Real first_rotation = 5;
  if (spec.names[0].rfind("LOAD_NODE", 0) == 0 || spec.names[0] == "LOAD_RIGID_BODY")
    return spec.number_of(entry, 0, dof_field) >= first_rotation ? "ML2/T2" : nullptr;
  constexpr std::size_t motion_card = 6, opt_field = 1;
  if (spec.names[0] == "RIGIDWALL_GEOMETRIC_FLAT")
    return spec.number_of(entry, motion_card, opt_field) == 1 ? "L" : nullptr;
  if (spec.names[0] == "CONSTRAINED_JOINT_SPHERICAL") {
    constexpr std::size_t motor_card = 2, type_field = 2;
    const Real type = spec.number_of(entry, motor_card, type_field);
    const std::string& name = spec.names[static_cast<std::size_t>(entry.name)];
    const bool turns = name == "CONSTRAINED_JOINT_ROTATIONAL_MOTOR";
    return type >= 0 && type <= 2 ? motion_values[static_cast<int>(type)][turns] : nullptr;
  }
  if (spec.names[0].rfind("BOUNDARY_PRESCRIBED_MOTION", 0) != 0) return nullptr;
  const Real dof = spec.number_of(entry, 0, dof_field), vad = spec.number_of(entry, 0, vad_field);
  if (!(vad >= 0 && vad <= 2)) return nullptr;  // refused later
  return motion_values[static_cast<int>(vad)][dof >= first_rotation];
}

struct ConvertedCurve {
  DefineCurveCard* card = nullptr;
  Real abscissa = 1, ordinate = 1;
  Entry user{};  ///< who told the factors
  bool used = false;
};

void use(const Deck& deck, const Entry& entry, const KeywordSpec& spec, const IdUse& id,
         ConvertedCurve& curve, Diagnostics& diagnostics) {
  const FieldSpec& field = spec.cards[id.card].fields[id.field];
  if (field.rules.honour != Honour::yes || !spec.lacking.empty()) return;  // no effect, or refused already
  const CurveDimensions* dimensions = curve_dimensions(spec.names[0], field.name);
  const char* of_entry = of_entry_itself(spec, entry);
  const char* hint =
      "give the curve in the deck's own units: in a file without unit factors, or through SFA and SFO";
  if (!dimensions) {
    deck.error(
        diagnostics, entry, field.name,
        fmt::format("curve {} stands in a file with unit factors, and the dimensions of its numbers are "
                    "not known here",
                    std::abs(id.id)),
        hint);
    return;
  }
  const UnitFactors& units = deck.files[static_cast<std::size_t>(curve.card->file)].conversion.units;
  const Real abscissa = units.of(dimensions->abscissa),
             ordinate = units.of(of_entry ? of_entry : dimensions->ordinate);
  if (curve.used && (curve.abscissa != abscissa || curve.ordinate != ordinate))
    deck.error(
        diagnostics, entry, field.name,
        fmt::format("curve {} stands in a file with unit factors, and its numbers have another dimension "
                    "here than for {} at {}",
                    std::abs(id.id), deck.keyword(curve.user), deck.place(curve.user)),
        hint);
  curve.abscissa = abscissa;
  curve.ordinate = ordinate;
  curve.user = entry;
  curve.used = true;
}

}  // namespace

const CurveDimensions* curve_dimensions(std::string_view keyword, std::string_view field) {
  for (const CurveDimensions& one : known)
    if (keyword == one.keyword && field == one.field) return &one;
  return nullptr;
}

void convert_curves(Deck& deck, Diagnostics& diagnostics) {
  std::map<Id, ConvertedCurve> curves;
  for (DefineCurveCard& card : deck.store<DefineCurveCard>())
    if (deck.files[static_cast<std::size_t>(card.file)].conversion.units.any())
      curves[card.lcid].card = &card;
  if (curves.empty()) return;
  const auto& registry = keyword_registry();
  for (std::size_t k = 0; k < registry.size(); ++k) {
    const KeywordSpec& spec = *registry[k];
    spec.for_each(deck, static_cast<std::int32_t>(k), [&](const Entry& entry) {
      spec.for_each_id(entry, [&](const IdUse& id) {
        if (id.space != IdSpace::curve || id.defines) return;
        const auto it = curves.find(std::abs(id.id));
        if (it != curves.end()) use(deck, entry, spec, id, it->second, diagnostics);
      });
    });
  }
  for (auto& [id, curve] : curves) {
    curve.card->sfa *= curve.abscissa;
    curve.card->sfo *= curve.ordinate;
  }
}

}  // namespace courant

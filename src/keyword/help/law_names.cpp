#include "keyword/help/law_names.hpp"

#include <algorithm>

namespace courant {

namespace {

constexpr LawName laws[] = {
    {"MAT", "001", "ELASTIC"},
    {"MAT", "002", "ORTHOTROPIC_ELASTIC"},
    {"MAT", "002_ANIS", "ANISOTROPIC_ELASTIC"},
    {"MAT", "003", "PLASTIC_KINEMATIC"},
    {"MAT", "004", "ELASTIC_PLASTIC_THERMAL"},
    {"MAT", "005", "SOIL_AND_FOAM"},
    {"MAT", "006", "VISCOELASTIC"},
    {"MAT", "007", "BLATZ_KO_RUBBER"},
    {"MAT", "008", "HIGH_EXPLOSIVE_BURN"},
    {"MAT", "009", "NULL"},
    {"MAT", "010", "ELASTIC_PLASTIC_HYDRO"},
    {"MAT", "011", "STEINBERG"},
    {"MAT", "012", "ISOTROPIC_ELASTIC_PLASTIC"},
    {"MAT", "013", "ISOTROPIC_ELASTIC_FAILURE"},
    {"MAT", "014", "SOIL_AND_FOAM_FAILURE"},
    {"MAT", "015", "JOHNSON_COOK"},
    {"MAT", "016", "PSEUDO_TENSOR"},
    {"MAT", "017", "ORIENTED_CRACK"},
    {"MAT", "018", "POWER_LAW_PLASTICITY"},
    {"MAT", "019", "STRAIN_RATE_DEPENDENT_PLASTICITY"},
    {"MAT", "020", "RIGID"},
    {"MAT", "021", "ORTHOTROPIC_THERMAL"},
    {"MAT", "022", "COMPOSITE_DAMAGE"},
    {"MAT", "023", "TEMPERATURE_DEPENDENT_ORTHOTROPIC"},
    {"MAT", "024", "PIECEWISE_LINEAR_PLASTICITY"},
    {"MAT", "025", "GEOLOGIC_CAP_MODEL"},
    {"MAT", "026", "HONEYCOMB"},
    {"MAT", "027", "MOONEY_RIVLIN_RUBBER"},
    {"MAT", "028", "RESULTANT_PLASTICITY"},
    {"MAT", "029", "FORCE_LIMITED"},
    {"MAT", "030", "SHAPE_MEMORY"},
    {"MAT", "031", "FRAZER_NASH_RUBBER_MODEL"},
    {"MAT", "032", "LAMINATED_GLASS"},
    {"MAT", "033", "BARLAT_ANISOTROPIC_PLASTICITY"},
    {"MAT", "034", "FABRIC"},
    {"MAT", "034M", "FABRIC_MAP"},
    {"MAT", "035", "PLASTIC_GREEN_NAGHDI_RATE"},
    {"MAT", "036", "3_PARAMETER_BARLAT"},
    {"MAT", "036E", "EXTENDED_3_PARAMETER_BARLAT"},
    {"MAT", "037", "TRANSVERSELY_ANISOTROPIC_ELASTIC_PLASTIC"},
    {"MAT", "038", "BLATZ_KO_FOAM"},
    {"MAT", "039", "FLD_TRANSVERSELY_ANISOTROPIC"},
    {"MAT", "040", "NONLINEAR_ORTHOTROPIC"},
    {"MAT", "041_050", "USER_DEFINED_MATERIAL_MODELS"},
    {"MAT", "051", "BAMMAN"},
    {"MAT", "052", "BAMMAN_DAMAGE"},
    {"MAT", "053", "CLOSED_CELL_FOAM"},
    {"MAT", "054", "ENHANCED_COMPOSITE_DAMAGE"},
    {"MAT", "055", "ENHANCED_COMPOSITE_DAMAGE"},
    {"MAT", "057", "LOW_DENSITY_FOAM"},
    {"MAT", "058", "LAMINATED_COMPOSITE_FABRIC"},
    {"MAT", "059", "COMPOSITE_FAILURE"},
    {"MAT", "060", "ELASTIC_WITH_VISCOSITY"},
    {"MAT", "060C", "ELASTIC_WITH_VISCOSITY_CURVE"},
    {"MAT", "061", "KELVIN_MAXWELL_VISCOELASTIC"},
    {"MAT", "062", "VISCOUS_FOAM"},
    {"MAT", "063", "CRUSHABLE_FOAM"},
    {"MAT", "064", "RATE_SENSITIVE_POWERLAW_PLASTICITY"},
    {"MAT", "065", "MODIFIED_ZERILLI_ARMSTRONG"},
    {"MAT", "066", "LINEAR_ELASTIC_DISCRETE_BEAM"},
    {"MAT", "067", "NONLINEAR_ELASTIC_DISCRETE_BEAM"},
    {"MAT", "068", "NONLINEAR_PLASTIC_DISCRETE_BEAM"},
    {"MAT", "069", "SID_DAMPER_DISCRETE_BEAM"},
    {"MAT", "070", "HYDRAULIC_GAS_DAMPER_DISCRETE_BEAM"},
    {"MAT", "071", "CABLE_DISCRETE_BEAM"},
    {"MAT", "072", "CONCRETE_DAMAGE"},
    {"MAT", "072R3", "CONCRETE_DAMAGE_REL3"},
    {"MAT", "073", "LOW_DENSITY_VISCOUS_FOAM"},
    {"MAT", "074", "ELASTIC_SPRING_DISCRETE_BEAM"},
    {"MAT", "075", "BILKHU/DUBOIS_FOAM"},
    {"MAT", "076", "GENERAL_VISCOELASTIC"},
    {"MAT", "077_H", "HYPERELASTIC_RUBBER"},
    {"MAT", "077_O", "OGDEN_RUBBER"},
    {"MAT", "078", "SOIL_CONCRETE"},
    {"MAT", "079", "HYSTERETIC_SOIL"},
    {"MAT", "080", "RAMBERG_OSGOOD"},
    {"MAT", "081", "PLASTICITY_WITH_DAMAGE"},
    {"MAT", "082", "PLASTICITY_WITH_DAMAGE_ORTHO"},
    {"MAT", "083", "FU_CHANG_FOAM"},
    {"MAT", "084", "WINFRITH_CONCRETE"},
    {"MAT", "086", "ORTHOTROPIC_VISCOELASTIC"},
    {"MAT", "087", "CELLULAR_RUBBER"},
    {"MAT", "088", "MTS"},
    {"MAT", "089", "PLASTICITY_POLYMER"},
    {"MAT", "090", "ACOUSTIC"},
    {"MAT", "091", "SOFT_TISSUE"},
    {"MAT", "092", "SOFT_TISSUE_VISCO"},
    {"MAT", "093", "ELASTIC_6DOF_SPRING_DISCRETE_BEAM"},
    {"MAT", "094", "INELASTIC_SPRING_DISCRETE_BEAM"},
    {"MAT", "096", "BRITTLE_DAMAGE"},
    {"MAT", "097", "GENERAL_JOINT_DISCRETE_BEAM"},
    {"MAT", "098", "SIMPLIFIED_JOHNSON_COOK"},
    {"MAT", "099", "SIMPLIFIED_JOHNSON_COOK_ORTHOTROPIC_DAMAGE"},
    {"MAT", "100", "SPOTWELD"},
    {"MAT", "101", "GEPLASTIC_SRATE_2000A"},
    {"MAT", "102", "INV_HYPERBOLIC_SIN"},
    {"MAT", "103", "ANISOTROPIC_VISCOPLASTIC"},
    {"MAT", "104", "DAMAGE_1"},
    {"MAT", "105", "DAMAGE_2"},
    {"MAT", "106", "ELASTIC_VISCOPLASTIC_THERMAL"},
    {"MAT", "107", "MODIFIED_JOHNSON_COOK"},
    {"MAT", "108", "ORTHO_ELASTIC_PLASTIC"},
    {"MAT", "110", "JOHNSON_HOLMQUIST_CERAMICS"},
    {"MAT", "111", "JOHNSON_HOLMQUIST_CONCRETE"},
    {"MAT", "112", "FINITE_ELASTIC_STRAIN_PLASTICITY"},
    {"MAT", "113", "TRIP"},
    {"MAT", "114", "LAYERED_LINEAR_PLASTICITY"},
    {"MAT", "115", "UNIFIED_CREEP"},
    {"MAT", "116", "COMPOSITE_LAYUP"},
    {"MAT", "117", "COMPOSITE_MATRIX"},
    {"MAT", "118", "COMPOSITE_DIRECT"},
    {"MAT", "119", "GENERAL_NONLINEAR_6DOF_DISCRETE_BEAM"},
    {"MAT", "120", "GURSON"},
    {"MAT", "121", "GENERAL_NONLINEAR_1DOF_DISCRETE_BEAM"},
    {"MAT", "122", "HILL_3R"},
    {"MAT", "123", "MODIFIED_PIECEWISE_LINEAR_PLASTICITY"},
    {"MAT", "124", "PLASTICITY_COMPRESSION_TENSION"},
    {"MAT", "125", "KINEMATIC_HARDENING_TRANSVERSELY_ANISOTROPIC"},
    {"MAT", "126", "MODIFIED_HONEYCOMB"},
    {"MAT", "127", "ARRUDA_BOYCE_RUBBER"},
    {"MAT", "128", "HEART_TISSUE"},
    {"MAT", "129", "LUNG_TISSUE"},
    {"MAT", "130", "SPECIAL_ORTHOTROPIC"},
    {"MAT", "131", "ISOTROPIC_SMEARED_CRACK"},
    {"MAT", "132", "ORTHOTROPIC_SMEARED_CRACK"},
    {"MAT", "133", "BARLAT_YLD2000"},
    {"MAT", "134", "VISCOELASTIC_FABRIC"},
    {"MAT", "135", "WTM_STM_PLC"},
    {"MAT", "136", "VEGTER"},
    {"MAT", "138", "COHESIVE_MIXED_MODE"},
    {"MAT", "139", "MODIFIED_FORCE_LIMITED"},
    {"MAT", "140", "VACUUM"},
    {"MAT", "141", "RATE_SENSITIVE_POLYMER"},
    {"MAT", "142", "TRANSVERSELY_ISOTROPIC_CRUSHABLE_FOAM"},
    {"MAT", "143", "WOOD"},
    {"MAT", "144", "PITZER_CRUSHABLE_FOAM"},
    {"MAT", "145", "SCHWER_MURRAY_CAP_MODEL"},
    {"MAT", "146", "1DOF_GENERALIZED_SPRING"},
    {"MAT", "147", "FHWA_SOIL"},
    {"MAT", "148", "GAS_MIXTURE"},
    {"MAT", "151", "EMMI"},
    {"MAT", "153", "DAMAGE_3"},
    {"MAT", "154", "DESHPANDE_FLECK_FOAM"},
    {"MAT", "155", "PLASTICITY_COMPRESSION_TENSION_EOS"},
    {"MAT", "156", "MUSCLE"},
    {"MAT", "157", "ANISOTROPIC_ELASTIC_PLASTIC"},
    {"MAT", "158", "RATE_SENSITIVE_COMPOSITE_FABRIC"},
    {"MAT", "159", "CSCM"},
    {"MAT", "160", "ALE_INCOMPRESSIBLE"},
    {"MAT", "161", "COMPOSITE_MSC"},
    {"MAT", "162", "COMPOSITE_MSC_DMG"},
    {"MAT", "163", "MODIFIED_CRUSHABLE_FOAM"},
    {"MAT", "165", "PLASTIC_NONLINEAR_KINEMATIC"},
    {"MAT", "165B", "PLASTIC_NONLINEAR_KINEMATIC_B"},
    {"MAT", "166", "MOMENT_CURVATURE_BEAM"},
    {"MAT", "167", "MCCORMICK"},
    {"MAT", "168", "POLYMER"},
    {"MAT", "169", "ARUP_ADHESIVE"},
    {"MAT", "170", "RESULTANT_ANISOTROPIC"},
    {"MAT", "171", "STEEL_CONCENTRIC_BRACE"},
    {"MAT", "172", "CONCRETE_EC2"},
    {"MAT", "173", "MOHR_COULOMB"},
    {"MAT", "174", "RC_BEAM"},
    {"MAT", "175", "VISCOELASTIC_THERMAL"},
    {"MAT", "176", "QUASILINEAR_VISCOELASTIC"},
    {"MAT", "177", "HILL_FOAM"},
    {"MAT", "178", "VISCOELASTIC_HILL_FOAM"},
    {"MAT", "179", "LOW_DENSITY_SYNTHETIC_FOAM"},
    {"MAT", "180", "LOW_DENSITY_SYNTHETIC_FOAM_ORTHO"},
    {"MAT", "181", "SIMPLIFIED_RUBBER"},
    {"MAT", "183", "SIMPLIFIED_RUBBER_WITH_DAMAGE"},
    {"MAT", "184", "COHESIVE_ELASTIC"},
    {"MAT", "185", "COHESIVE_TH"},
    {"MAT", "186", "COHESIVE_GENERAL"},
    {"MAT", "187", "SAMP_1"},
    {"MAT", "187L", "SAMP_LIGHT"},
    {"MAT", "188", "THERMO_ELASTO_VISCOPLASTIC_CREEP"},
    {"MAT", "189", "ANISOTROPIC_THERMOELASTIC"},
    {"MAT", "190", "FLD_3_PARAMETER_BARLAT"},
    {"MAT", "191", "SEISMIC_BEAM"},
    {"MAT", "192", "SOIL_BRICK"},
    {"MAT", "193", "DRUCKER_PRAGER"},
    {"MAT", "194", "RC_SHEAR_WALL"},
    {"MAT", "195", "CONCRETE_BEAM"},
    {"MAT", "196", "GENERAL_SPRING_DISCRETE_BEAM"},
    {"MAT", "198", "JOINTED_ROCK"},
    {"MAT", "199", "BARLAT_YLD2004"},
    {"MAT", "202", "STEEL_EC3"},
    {"MAT", "203", "HYSTERETIC_REINFORCEMENT"},
    {"MAT", "205", "DISCRETE_BEAM_POINT_CONTACT"},
    {"MAT", "208", "BOLT_BEAM"},
    {"MAT", "209", "HYSTERETIC_BEAM"},
    {"MAT", "211", "SPR_JLR"},
    {"MAT", "213", "COMPOSITE_TABULATED_PLASTICITY_DAMAGE"},
    {"MAT", "214", "DRY_FABRIC"},
    {"MAT", "215", "4A_MICROMEC"},
    {"MAT", "216", "ELASTIC_PHASE_CHANGE"},
    {"MAT", "217", "ORTHOTROPIC_ELASTIC_PHASE_CHANGE"},
    {"MAT", "219", "CODAM2"},
    {"MAT", "220", "RIGID_DISCRETE"},
    {"MAT", "221", "ORTHOTROPIC_SIMPLIFIED_DAMAGE"},
    {"MAT", "224", "TABULATED_JOHNSON_COOK"},
    {"MAT", "226", "KINEMATIC_HARDENING_BARLAT89"},
    {"MAT", "230", "PML_ELASTIC_FLUID"},
    {"MAT", "231", "PML_ACOUSTIC"},
    {"MAT", "233", "CAZACU_BARLAT"},
    {"MAT", "234", "VISCOELASTIC_LOOSE_FABRIC"},
    {"MAT", "235", "MICROMECHANICS_DRY_FABRIC"},
    {"MAT", "236", "SCC_ON_RCC"},
    {"MAT", "240", "COHESIVE_MIXED_MODE_ELASTOPLASTIC_RATE"},
    {"MAT", "241", "JOHNSON_HOLMQUIST_JH1"},
    {"MAT", "242", "KINEMATIC_HARDENING_BARLAT2000"},
    {"MAT", "243", "HILL_90"},
    {"MAT", "244", "UHS_STEEL"},
    {"MAT", "245", "PML_ORTHOTROPIC_ELASTIC"},
    {"MAT", "246", "PML_NULL"},
    {"MAT", "248", "PHS_BMW"},
    {"MAT", "251", "TAILORED_PROPERTIES"},
    {"MAT", "252", "TOUGHENED_ADHESIVE_POLYMER"},
    {"MAT", "254", "GENERALIZED_PHASE_CHANGE"},
    {"MAT", "255", "PIECEWISE_LINEAR_PLASTIC_THERMAL"},
    {"MAT", "256", "AMORPHOUS_SOLIDS_FINITE_STRAIN"},
    {"MAT", "258", "NON_QUADRATIC_FAILURE"},
    {"MAT", "260A", "STOUGHTON_NON_ASSOCIATED_FLOW"},
    {"MAT", "260B", "MOHR_NON_ASSOCIATED_FLOW"},
    {"MAT", "261", "LAMINATED_FRACTURE_DAIMLER_PINHO"},
    {"MAT", "262", "LAMINATED_FRACTURE_DAIMLER_CAMANHO"},
    {"MAT", "263", "LOU_YOON_ANISOTROPIC_PLASTICITY"},
    {"MAT", "264", "TABULATED_JOHNSON_COOK_ORTHO_PLASTICITY"},
    {"MAT", "266", "TISSUE_DISPERSED"},
    {"MAT", "267", "EIGHT_CHAIN_RUBBER"},
    {"MAT", "269", "BERGSTROM_BOYCE_RUBBER"},
    {"MAT", "270", "CWM"},
    {"MAT", "271", "POWDER"},
    {"MAT", "272", "RHT"},
    {"MAT", "273", "CONCRETE_DAMAGE_PLASTIC_MODEL"},
    {"MAT", "273", "CDPM"},
    {"MAT", "274", "PAPER"},
    {"MAT", "275", "SMOOTH_VISCOELASTIC_VISCOPLASTIC"},
    {"MAT", "276", "CHRONOLOGICAL_VISCOELASTIC"},
    {"MAT", "277", "ADHESIVE_CURING_VISCOELASTIC"},
    {"MAT", "278", "CF_MICROMECHANICS"},
    {"MAT", "279", "COHESIVE_PAPER"},
    {"MAT", "280", "GLASS"},
    {"MAT", "291", "SHAPE_MEMORY_ALLOY"},
    {"MAT", "292", "ELASTIC_PERI"},
    {"MAT", "292A", "ELASTIC_PERI_LAMINATE"},
    {"MAT", "293", "COMPRF"},
    {"MAT", "295", "ANISOTROPIC_HYPERELASTIC"},
    {"MAT", "296", "ANAND_VISCOPLASTICITY"},
    {"MAT", "305", "HOT_PLATE_ROLLING"},
    {"MAT", "318", "TNM_POLYMER"},
    {"MAT", "319", "IFPD"},
    {"MAT", "326", "COHESIVE_GASKET"},
    {"MAT", "S01", "SPRING_ELASTIC"},
    {"MAT", "S02", "DAMPER_VISCOUS"},
    {"MAT", "S03", "SPRING_ELASTOPLASTIC"},
    {"MAT", "S04", "SPRING_NONLINEAR_ELASTIC"},
    {"MAT", "S05", "DAMPER_NONLINEAR_VISCOUS"},
    {"MAT", "S06", "SPRING_GENERAL_NONLINEAR"},
    {"MAT", "S07", "SPRING_MAXWELL"},
    {"MAT", "S08", "SPRING_INELASTIC"},
    {"MAT", "B01", "SEATBELT"},
    {"MAT", "T01", "THERMAL_ISOTROPIC"},
    {"MAT", "T02", "THERMAL_ORTHOTROPIC"},
    {"EOS", "001", "LINEAR_POLYNOMIAL"},
    {"EOS", "002", "JWL"},
    {"EOS", "003", "SACK_TUESDAY"},
    {"EOS", "004", "GRUNEISEN"},
    {"EOS", "005", "RATIO_OF_POLYNOMIALS"},
    {"EOS", "006", "LINEAR_POLYNOMIAL_WITH_ENERGY_LEAK"},
    {"EOS", "007", "IGNITION_AND_GROWTH_OF_REACTION_IN_HE"},
    {"EOS", "008", "TABULATED_COMPACTION"},
    {"EOS", "009", "TABULATED"},
    {"EOS", "010", "PROPELLANT_DEFLAGRATION"},
    {"EOS", "011", "TENSOR_PORE_COLLAPSE"},
    {"EOS", "012", "IDEAL_GAS"},
    {"EOS", "013", "PHASE_CHANGE"},
    {"EOS", "014", "JWLB"},
    {"EOS", "015", "GASKET"},
    {"EOS", "016", "MIE_GRUNEISEN"},
    {"EOS", "019", "MURNAGHAN"},
    {"EOS", "021", "USER_DEFINED"},
};

/// "MAT_BLATZ-KO_RUBBER" and "MAT_BLATZ_KO_RUBBER" are both in use.
bool same_letter(char a, char b) {
  return a == b || (a == '-' && b == '_') || (a == '_' && b == '-');
}

/// Whether `text` begins with `words` and a word ends there.
bool begins_with_words(std::string_view text, std::string_view words) {
  if (text.size() < words.size() || !std::equal(words.begin(), words.end(), text.begin(), same_letter))
    return false;
  return text.size() == words.size() || text[words.size()] == '_' || text[words.size()] == '/' ||
         text[words.size()] == '-';
}

/// What is behind "MAT_" or "EOS_"; empty for other keywords.
std::string_view behind_family(std::string_view keyword) {
  const bool law = keyword.rfind("MAT_", 0) == 0 || keyword.rfind("EOS_", 0) == 0;
  return law ? keyword.substr(4) : std::string_view();
}

}  // namespace

const LawName* find_law(std::string_view keyword, std::size_t* length) {
  const std::string_view words = behind_family(keyword);
  const LawName* best = nullptr;
  std::size_t longest = 0;
  if (words.empty()) return nullptr;
  for (const LawName& law : laws) {
    if (keyword.substr(0, 3) != law.family) continue;
    for (const std::string_view one : {std::string_view(law.number), std::string_view(law.name)})
      if (one.size() > longest && begins_with_words(words, one)) {
        best = &law;
        longest = one.size();
      }
  }
  if (length) *length = best ? longest + 4 : 0;
  return best;
}

bool has_law_number(std::string_view keyword) {
  const std::string_view words = behind_family(keyword);
  const auto is_digit = [&](std::size_t k) { return k < words.size() && words[k] >= '0' && words[k] <= '9'; };
  const bool thermal_or_spring = !words.empty() && (words[0] == 'S' || words[0] == 'T' || words[0] == 'B');
  return thermal_or_spring ? is_digit(1) && is_digit(2) : is_digit(0) && is_digit(1) && is_digit(2);
}

void add_law_names(std::vector<std::string>& names) {
  const std::size_t given = names.size();
  for (std::size_t k = 0; k < given; ++k) {
    std::size_t length = 0;
    const LawName* law = find_law(names[k], &length);
    if (!law) continue;
    const std::string option = names[k].substr(length);
    for (const char* one : {law->name, law->number}) {
      const std::string other = std::string(law->family) + "_" + one + option;
      if (std::find(names.begin(), names.end(), other) == names.end()) names.push_back(other);
    }
  }
}

}  // namespace courant

#include "keyword/help/families.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>

#include "keyword/help/law_names.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

struct Family {
  const char* prefix;  ///< whole words
  const char* what;    ///< "airbags"; "this ..." where supported ones of the same prefix exist
  const char* hint = "";
};

/// The longest prefix that fits counts.
constexpr Family families[] = {
    {"AIRBAG", "airbags"},
    {"ALE", "ALE meshes"},
    {"BATTERY", "batteries"},
    {"BOUNDARY", "this boundary condition"},
    {"BOUNDARY_ACOUSTIC", "acoustic boundary conditions"},
    {"BOUNDARY_ALE", "ALE meshes"},
    {"BOUNDARY_AMBIENT", "ambient boundaries of ALE meshes"},
    {"BOUNDARY_CYCLIC", "cyclic boundaries"},
    {"BOUNDARY_DE", "discrete element spheres"},
    {"BOUNDARY_NON_REFLECTING", "plane non-reflecting boundaries"},
    {"BOUNDARY_PORE", "pore pressures"},
    {"BOUNDARY_PRESCRIBED_ACCELEROMETER", "prescribed motions"},
    {"BOUNDARY_PRESCRIBED_FINAL_GEOMETRY", "prescribed motions"},
    {"BOUNDARY_PRESCRIBED_MOTION", "prescribed motions"},
    {"BOUNDARY_PRESCRIBED_ORIENTATION", "prescribed motions"},
    {"BOUNDARY_PRESSURE", "pressure boundaries"},
    {"BOUNDARY_PWP", "pore pressures"},
    {"BOUNDARY_SALE", "ALE meshes"},
    {"BOUNDARY_SLIDING_PLANE", "sliding planes"},
    {"BOUNDARY_SPC", "this kind of constraint"},
    {"BOUNDARY_SPH_FLOW", "SPH flow planes"},
    {"BOUNDARY_SPH_NOSLIP", "no-slip walls of particles"},
    {"BOUNDARY_SPH_NON_REFLECTING", "non-reflecting boundaries"},
    {"BOUNDARY_SPH_PERIODIC", "periodic boundaries of particles"},
    {"BOUNDARY_SPH_SYMMETRY_PLANE", "SPH symmetry planes"},
    {"CESE", "compressible flows (CESE)"},
    {"CHANGE", "this change at a restart"},
    {"CHEMISTRY", "chemical reactions"},
    {"COMPONENT", "occupant dummies"},
    {"CONSTRAINED", "this constraint"},
    {"CONSTRAINED_BEAM_IN_SOLID", "beams inside solids"},
    {"CONSTRAINED_BUTT_WELD", "welds"},
    {"CONSTRAINED_EXTRA_NODES", "extra nodes of rigid bodies"},
    {"CONSTRAINED_GENERALIZED_WELD", "welds"},
    {"CONSTRAINED_INTERPOLATION", "interpolation along local axes"},
    {"CONSTRAINED_JOINT", "this kind of joint"},
    {"CONSTRAINED_LAGRANGE_IN_SOLID", "couplings to ALE meshes"},
    {"CONSTRAINED_LINEAR", "linear constraints"},
    {"CONSTRAINED_LOCAL", "constraints along local axes"},
    {"CONSTRAINED_NODAL_RIGID_BODY", "this form of nodal rigid bodies"},
    {"CONSTRAINED_RIVET", "rivets"},
    {"CONSTRAINED_SOIL_PILE", "piles in soil"},
    {"CONSTRAINED_SPOTWELD", "welds"},
    {"CONSTRAINED_TIED_NODES_FAILURE", "tied nodes"},
    {"CONTACT", "this kind of contact"},
    {"CONTROL", "this control card"},
    {"CONTROL_ADAPT", "adaptive meshes"},
    {"CONTROL_ADAPTIVE", "adaptive meshes"},
    {"CONTROL_AIRBAG", "airbags"},
    {"CONTROL_ALE", "ALE meshes"},
    {"CONTROL_COARSEN", "adaptive meshes"},
    {"CONTROL_COUPLING", "couplings to other programs"},
    {"CONTROL_CPM", "corpuscular gas particles"},
    {"CONTROL_DISCRETE_ELEMENT", "discrete element spheres"},
    {"CONTROL_EFG", "element-free Galerkin methods"},
    {"CONTROL_EXPLICIT_THERMAL", "thermal analyses"},
    {"CONTROL_FORMING", "metal-forming tools"},
    {"CONTROL_FREQUENCY_DOMAIN", "frequency-domain analyses"},
    {"CONTROL_PORE", "pore pressures"},
    {"CONTROL_REFINE", "adaptive meshes"},
    {"CONTROL_REMESHING", "adaptive meshes"},
    {"CONTROL_STAGED_CONSTRUCTION", "staged constructions"},
    {"CONTROL_SUBCYCLE", "different steps for different elements"},
    {"CONTROLLER", "controllers"},
    {"COSIM", "couplings to other programs"},
    {"DAMPING", "this kind of damping"},
    {"DEFINE", "this definition"},
    {"DEFINE_ADAPTIVE", "adaptive meshes"},
    {"DEFINE_ALEBAG", "airbags"},
    {"DEFINE_BOX", "this kind of box"},
    {"DEFINE_CONSTRUCTION_STAGES", "staged constructions"},
    {"DEFINE_COORDINATE", "this kind of coordinate system"},
    {"DEFINE_CPM", "corpuscular gas particles"},
    {"DEFINE_CURVE", "this kind of curve"},
    {"DEFINE_DEATH_TIMES", "ends of motions of rigid bodies by position",
     "DEATH of *BOUNDARY_PRESCRIBED_MOTION_RIGID ends one at a time"},
    {"DEFINE_DE", "discrete element spheres"},
    {"DEFINE_ELEMENT_DEATH", "this kind of deletion at a time"},
    {"DEFINE_FORMING", "metal-forming tools"},
    {"DEFINE_FRICTION", "friction tables"},
    {"DEFINE_SPH_INJECTION", "inlets of particles"},
    {"DEFINE_SPH_MESH", "particles made by keyword"},
    {"DEFINE_STAGED_CONSTRUCTION", "staged constructions"},
    {"DEFINE_TABLE", "this kind of table"},
    {"DEFINE_TRANSFORMATION", "transformations"},
    {"DEFINE_VECTOR", "this kind of vector"},
    {"DEFORMABLE_TO_RIGID", "inertia given to parts that become rigid"},
    {"DELETE", "this deletion at a restart"},
    {"DELETE_ELEMENT_TSHELL", "thick shells"},
    {"DUALCESE", "compressible flows (dual CESE)"},
    {"EF", "exchange factors of radiation"},
    {"ELEMENT", "this kind of element"},
    {"ELEMENT_BEAM", "beam elements"},
    {"ELEMENT_BEARING", "bearings"},
    {"ELEMENT_BLANKING", "metal-forming tools"},
    {"ELEMENT_DISCRETE_LCO", "springs and dampers with offsets by curves"},
    {"ELEMENT_DISCRETE_SPHERE", "discrete element spheres"},
    {"ELEMENT_GENERALIZED", "user-defined elements"},
    {"ELEMENT_INERTIA", "lumped inertias"},
    {"ELEMENT_LANCING", "metal-forming tools"},
    {"ELEMENT_MASS", "lumped masses"},
    {"ELEMENT_SEATBELT", "seat belts"},
    {"ELEMENT_SHELL", "this form of shell elements"},
    {"ELEMENT_SOLID", "solid elements"},
    {"ELEMENT_SOLID_H27", "solids with so many nodes"},
    {"ELEMENT_SOLID_H64", "solids with so many nodes"},
    {"ELEMENT_SOLID_H8TOH27", "solids with so many nodes"},
    {"ELEMENT_SOLID_H8TOH64", "solids with so many nodes"},
    {"ELEMENT_SOLID_P21", "solids with so many nodes"},
    {"ELEMENT_SOLID_P40", "solids with so many nodes"},
    {"ELEMENT_SOLID_T20", "solids with so many nodes"},
    {"ELEMENT_TRIM", "metal-forming tools"},
    {"ELEMENT_TSHELL", "thick shell elements"},
    {"EM", "electromagnetic fields"},
    {"EOS", "this equation of state"},
    {"FATIGUE", "fatigue analyses"},
    {"FREQUENCY_DOMAIN", "frequency-domain analyses"},
    {"HOURGLASS", "this kind of hourglass control"},
    {"ICFD", "incompressible flows (ICFD)"},
    {"IGA", "isogeometric elements"},
    {"INCLUDE", "this method of including files"},
    {"INCLUDE_BINARY", "binary files"},
    {"INCLUDE_COMPENSATION", "springback compensations"},
    {"INCLUDE_MULTISCALE", "multiscale models"},
    {"INCLUDE_NASTRAN", "Nastran files"},
    {"INCLUDE_STAMPED", "results of stamping"},
    {"INITIAL", "this initial condition"},
    {"INITIAL_DETONATION", "detonations"},
    {"INITIAL_FOAM_REFERENCE_GEOMETRY", "reference geometries"},
    {"INITIAL_PWP", "pore pressures"},
    {"INITIAL_STRESS", "initial stresses"},
    {"INITIAL_STRESS_TSHELL", "initial stresses of thick shells"},
    {"INITIAL_TEMPERATURE", "initial temperatures"},
    {"INITIAL_VOLUME_FRACTION", "volume fractions of ALE meshes"},
    {"INTEGRATION", "user-defined integration rules"},
    {"INTERFACE", "interface files"},
    {"INTERFACE_SPRINGBACK", "analyses of springback in the run"},
    {"LOAD", "this load"},
    {"LOAD_BEAM", "loads on beams"},
    {"LOAD_BLAST", "blast loads"},
    {"LOAD_BODY", "this body load"},
    {"LOAD_BODY_RX", "rotational body loads"},
    {"LOAD_BODY_RY", "rotational body loads"},
    {"LOAD_BODY_RZ", "rotational body loads"},
    {"LOAD_GRAVITY", "gravity that is switched on in stages"},
    {"LOAD_NODE", "this kind of force on nodes"},
    {"LOAD_RIGID_BODY", "forces on rigid bodies"},
    {"LOAD_SEGMENT", "pressures on segments"},
    {"LOAD_SEISMIC", "seismic loads"},
    {"LOAD_SHELL", "pressures on shells"},
    {"LOAD_SSA", "underwater explosions"},
    {"LOAD_THERMAL", "thermal loads"},
    {"MAT", "this material"},
    {"MAT_ADD", "additions to materials"},
    {"MAT_NONLOCAL", "non-local materials"},
    {"MESH", "meshers of the flow solvers"},
    {"MODULE", "user modules"},
    {"NODE", "this form of nodes"},
    {"PARAMETER", "this form of parameters"},
    {"PART", "this form of parts"},
    {"PART_COMPOSITE", "this form of layered composites"},
    {"PART_DUPLICATE", "copies of parts"},
    {"PART_MODES", "flexible bodies by modes"},
    {"PARTICLE", "particles of gas or blast"},
    {"PERTURBATION", "perturbations"},
    {"RAIL", "rails"},
    {"RIGIDWALL", "rigid walls"},
    {"RVE", "representative volumes"},
    {"SECTION", "this kind of section"},
    {"SECTION_IGA", "isogeometric elements"},
    {"SECTION_SEATBELT", "seat belts"},
    {"SECTION_SOLID", "solid elements"},
    {"SECTION_TSHELL", "thick shell elements"},
    {"SENSOR", "this kind of sensor"},
    {"SET", "this form of set"},
    {"SET_BEAM", "sets of beams"},
    {"SET_IGA", "isogeometric elements"},
    {"SET_MODE", "sets of modes"},
    {"SET_SEGMENT", "sets of segments"},
    {"SET_SOLID", "sets of solid elements"},
    {"SPH", "this SPH keyword"},
    {"STOCHASTIC", "stochastic particles"},
    {"TERMINATION", "this criterion of termination"},
    {"TRANSLATE", "translations of other formats"},
    {"USER", "user subroutines"},
};

struct WithoutEffect {
  const char* words;
  const char* reason;
};
constexpr const char* not_referred_to = "nothing here refers to it";
constexpr const char* not_thermal = "there is no thermal analysis (SOLN of *CONTROL_SOLUTION)";
constexpr const char* not_implicit = "the steps are explicit (IMFLAG of *CONTROL_IMPLICIT_GENERAL)";
constexpr WithoutEffect without_effect[] = {
    {"BOUNDARY_CONVECTION", not_thermal},
    {"BOUNDARY_FLUX", not_thermal},
    {"BOUNDARY_RADIATION", not_thermal},
    {"BOUNDARY_TEMPERATURE", not_thermal},
    {"BOUNDARY_THERMAL", not_thermal},
    {"CONTROL_IMPLICIT", not_implicit},
    {"CONTROL_THERMAL", not_thermal},
    {"DEFINE_BOX_ADAPTIVE", not_referred_to},
    {"DEFINE_BOX_COARSEN", not_referred_to},
    {"DEFINE_BOX_DRAWBEAD", not_referred_to},
    {"DEFINE_CONTACT_VOLUME", not_referred_to},
    {"DEFINE_CPM", not_referred_to},
    {"DEFINE_FILTER", not_referred_to},
    {"DEFINE_PLANE", not_referred_to},
    {"DEFINE_REGION", not_referred_to},
    {"LOAD_HEAT", not_thermal},
    {"MAT_THERMAL", not_thermal},
    {"SET_2D", not_referred_to},
    {"SET_DISCRETE", not_referred_to},
    {"SET_MULTI", not_referred_to},
    {"SET_TSHELL", not_referred_to},
};

bool begins_with_words(const std::string& text, const std::string& words) {
  if (text.size() < words.size()) return false;
  for (std::size_t k = 0; k < words.size(); ++k)
    if (text[k] != words[k] && !(text[k] == '-' && words[k] == '_')) return false;
  return text.size() == words.size() || text[words.size()] == '_' || text[words.size()] == '-';
}

bool begins_with_any(const std::string& text, const std::vector<std::string>& all) {
  return std::any_of(all.begin(), all.end(),
                     [&](const std::string& words) { return begins_with_words(text, words); });
}

/// No slips of the pen, though near to the name of something else.
bool is_known(const std::string& name) {
  static const std::vector<std::string> known{
      "DATABASE_RWFORC", "DATABASE_PBSTAT", "DATABASE_ACEOUT",       "BOUNDARY_SPC_SYMMETRY_PLANE",
      "CONTROL_CPM",     "ELEMENT_TSHELL",  "INITIAL_STRESS_TSHELL", "LOAD_BODY_RX",
      "LOAD_BODY_RY",    "LOAD_BODY_RZ",    "SECTION_FPD",           "SECTION_TSHELL",
      "SET_MODE",        "SET_NODE_GENERAL"};
  return begins_with_any(name, known) || find_law(name) || has_law_number(name);
}

/// The candidate with the fewest edits, at most `most`; empty: none.
std::string nearest(const std::string& name, const std::vector<std::string>& candidates, std::size_t most) {
  std::string best;
  for (const std::string& one : candidates) {
    if (one.size() > name.size() + most || name.size() > one.size() + most) continue;
    const std::size_t edits = edit_distance(name, one);
    if (edits > most) continue;
    best = one;
    if (edits == 0) break;
    most = edits - 1;
  }
  return best;
}

const Family* family_of(const std::string& name) {
  const Family* best = nullptr;
  std::size_t longest = 0;
  for (const Family& family : families) {
    const std::string prefix = family.prefix;
    if (prefix.size() <= longest || !begins_with_words(name, prefix)) continue;
    best = &family;
    longest = prefix.size();
  }
  return best;
}

bool is_this(const std::string& what) {
  return what.rfind("this ", 0) == 0;
}

/// Edits in a longer name, and in one below that many letters only one.
constexpr std::size_t slip_of_the_pen = 2, shortest_for_two = 8;

}  // namespace

std::vector<std::string> output_requests() {
  return {"DATABASE",
          "CONTROL_OUTPUT",
          "CONTROL_PARALLEL",
          "CONTROL_MPP",
          "CONTROL_UNITS",
          "CONTROL_LSDA",
          "CONTROL_DEBUG",
          "CONTROL_REQUIRE_REVISION",
          "LSO",
          "ELEMENT_PLOTEL",
          "INTERFACE_COMPONENT",
          "INTERFACE_SPRINGBACK_LSDYNA",
          "INTERFACE_SPRINGBACK_NASTRAN",
          "INTERFACE_SPRINGBACK_DYNA3D",
          "INTERFACE_SPRINGBACK_NIKE3D",

          "INITIAL_STRAIN"};
}

std::vector<std::string> keywords_without_effect() {
  std::vector<std::string> out;
  for (const WithoutEffect& one : without_effect) out.push_back(one.words);
  return out;
}

const char* why_without_effect(const std::string& name) {
  if (name.size() >= 7 && name.rfind("MAT_T", 0) == 0 && std::isdigit(static_cast<unsigned char>(name[5])) &&
      std::isdigit(static_cast<unsigned char>(name[6])))
    return not_thermal;
  const auto at = std::find_if(std::begin(without_effect), std::end(without_effect),
                               [&](const WithoutEffect& one) { return begins_with_words(name, one.words); });
  return at == std::end(without_effect) ? nullptr : at->reason;
}

bool is_output_request(const std::string& name) {
  return begins_with_any(name, output_requests());
}

std::vector<std::pair<std::string, std::string>> refused_families() {
  std::vector<std::pair<std::string, std::string>> out;
  for (const Family& family : families) out.emplace_back(family.prefix, family.what);
  return out;
}

std::string not_supported(const std::string& lacking) {
  return fmt::format("{} {} not supported", lacking, is_this(lacking) ? "is" : "are");
}

Families::Families(std::vector<std::string> supported, std::vector<std::string> read)
    : supported_(std::move(supported)), read_(std::move(read)) {
  std::sort(supported_.begin(), supported_.end());
  std::sort(read_.begin(), read_.end());
}

Families::Families() {
  for (const auto& spec : keyword_registry())
    for (const std::string& name : spec->names) (spec->lacking.empty() ? supported_ : read_).push_back(name);
  std::sort(supported_.begin(), supported_.end());
  std::sort(read_.begin(), read_.end());
}

/// The longest of `names` that `name` continues with an option.
std::string Families::base_of(const std::string& name, const std::vector<std::string>& names) const {
  std::string base;
  for (const std::string& known : names)
    if (name.size() > known.size() && known.size() > base.size() && begins_with_words(name, known))
      base = known;
  return base;
}

Refusal Families::option(const std::string& name, const std::string& base) const {
  const std::string words = name.substr(base.size());
  return {fmt::format("this option ({})", words),
          fmt::format("*{} is supported, its option {} is not", base, words)};
}

/// "supported: *EOS_LINEAR_POLYNOMIAL, *EOS_MURNAGHAN".
std::string Families::supported_beginning_with(const std::string& prefix) const {
  constexpr std::size_t most = 6;
  std::vector<std::string> found;
  for (const std::string& name : supported_)
    if (begins_with_words(name, prefix) && name != prefix && !has_law_number(name)) found.push_back(name);
  const std::size_t count = found.size();
  if (count > most) found.resize(most);
  if (count == 0) return {};
  return fmt::format(
      "supported: *{}{}", fmt::join(found, ", *"),
      count > most ? fmt::format(" and {} more, see `courant keywords {}`", count - most, prefix) : "");
}

std::string Families::slip(const std::string& name, std::size_t most) const {
  if (is_known(name)) return {};
  std::string near = nearest(name, supported_, most);
  if (near.empty()) near = nearest(name, read_, most);
  return near.empty() ? std::string() : fmt::format("did you mean *{}?", near);
}

Refusal Families::refusal(const std::string& name) const {
  const std::size_t end = name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-");
  if (end != std::string::npos) {  // no name: something stands right behind one
    const std::string base = name.substr(0, end);
    if (std::find(supported_.begin(), supported_.end(), base) != supported_.end())
      return {"", fmt::format("did you mean *{}? A blank ends the name", base)};
  }
  std::size_t law_length = 0;
  const LawName* law = find_law(name, &law_length);
  const std::string base = base_of(name, supported_);
  const Family* family = family_of(name);
  const bool is_family = family && name == family->prefix;  // however near another name is
  if (std::string hint = slip(name, name.size() < shortest_for_two ? 1 : slip_of_the_pen);
      !hint.empty() && !is_family)
    return {"", std::move(hint)};
  const bool longer_family = family && std::string(family->prefix).size() > base.size();
  if (!base.empty() && base.size() >= law_length && !longer_family) return option(name, base);
  if (law) {
    // by the other one of its two names
    const bool by_number = name.compare(4, std::string(law->number).size(), law->number) == 0;
    return {
        fmt::format("this {} ({}_{})", std::string(law->family) == "MAT" ? "material" : "equation of state",
                    law->family, by_number ? law->name : law->number),
        supported_beginning_with(law->family)};
  }
  if (family)
    return {family->what, is_this(family->what) ? supported_beginning_with(family->prefix) : family->hint};
  constexpr std::size_t longest = 100;  // a whole line is no slip of the pen, and takes long to compare
  const std::string near = name.size() > longest ? std::string() : nearest_word(name, supported_);
  return {"", near.empty() ? "`courant keywords` lists the supported keywords"
                           : fmt::format("did you mean *{}?", near)};
}

}  // namespace courant

// Keywords without a table: what the refusal says.
#include <gtest/gtest.h>

#include <algorithm>

#include "keyword/help/families.hpp"
#include "keyword/help/law_names.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

/// Holds whatever the registry may grow to.
const Families& families() {
  static const Families few(
      {"CONTROL_SPH", "ELEMENT_SHELL", "MAT_NULL", "MAT_009", "MAT_RIGID", "MAT_020", "EOS_MURNAGHAN",
       "EOS_LINEAR_POLYNOMIAL", "LOAD_BODY_X", "SECTION_SPH", "NODE", "PART",
       "CONTACT_AUTOMATIC_NODES_TO_SURFACE", "SET_NODE_LIST", "INITIAL_VELOCITY"},
      {"ELEMENT_SOLID"});
  return few;
}

std::string lacking(const std::string& name) {
  return families().refusal(name).lacking;
}
std::string hint(const std::string& name) {
  return families().refusal(name).hint;
}

TEST(Families, NameWhatIsLacking) {
  EXPECT_EQ(lacking("AIRBAG_SIMPLE_PRESSURE_VOLUME_ID"), "airbags");
  EXPECT_EQ(lacking("ICFD_PART"), "incompressible flows (ICFD)");
  EXPECT_EQ(lacking("CONSTRAINED_JOINT_CONSTANT_VELOCITY"), "this kind of joint");
  EXPECT_EQ(lacking("CONSTRAINED_SOMETHING_NEW"), "this constraint");
  EXPECT_EQ(lacking("CONTROL_COUPLING"), "couplings to other programs");
  EXPECT_EQ(lacking("RIGIDWALL_PLANAR"), "rigid walls");
  EXPECT_EQ(not_supported("airbags"), "airbags are not supported");
  EXPECT_EQ(not_supported("this constraint"), "this constraint is not supported");
}

TEST(Families, NameWhatServesInstead) {
  EXPECT_NE(hint("DEFINE_DEATH_TIMES_RIGID").find("DEATH of *BOUNDARY_PRESCRIBED_MOTION_RIGID"),
            std::string::npos);
  EXPECT_EQ(hint("AIRBAG_SIMPLE_PRESSURE_VOLUME"), "");
}

TEST(Families, LongestPrefixCounts) {
  EXPECT_EQ(lacking("ELEMENT_DISCRETE_LCO"), "springs and dampers with offsets by curves");
  EXPECT_EQ(lacking("ELEMENT_DISCRETE_SPHERE_VOLUME"), "discrete element spheres");
  EXPECT_EQ(lacking("ELEMENT_TSHELL"), "thick shell elements");
}

TEST(Families, WholeWordsOnly) {
  EXPECT_EQ(lacking("EMPTY_WORD"), "");  // not EM, electromagnetics
  EXPECT_EQ(lacking("CASEWORK_X"), "");  // not CASE
  EXPECT_EQ(lacking("EM_CONTROL"), "electromagnetic fields");
}

TEST(Families, LawsAreNamedByNumberAndByName) {
  EXPECT_EQ(lacking("MAT_024"), "this material (MAT_PIECEWISE_LINEAR_PLASTICITY)");
  EXPECT_EQ(lacking("MAT_PIECEWISE_LINEAR_PLASTICITY_HAZ_TITLE"), "this material (MAT_024)");
  EXPECT_EQ(lacking("MAT_OGDEN_RUBBER"), "this material (MAT_077_O)");
  EXPECT_EQ(lacking("MAT_077_O"), "this material (MAT_OGDEN_RUBBER)");
  EXPECT_EQ(lacking("MAT_BLATZ-KO_FOAM"), "this material (MAT_038)");
  EXPECT_EQ(lacking("EOS_JWLB"), "this equation of state (EOS_014)");
  EXPECT_EQ(lacking("EOS_011"), "this equation of state (EOS_TENSOR_PORE_COLLAPSE)");
  EXPECT_EQ(hint("EOS_011"), "supported: *EOS_LINEAR_POLYNOMIAL, *EOS_MURNAGHAN");
  EXPECT_EQ(lacking("MAT_999"), "this material");  // no number is a typing error for another
  EXPECT_EQ(hint("MAT_999"), "supported: *MAT_NULL, *MAT_RIGID");
}

TEST(Families, LawThatContinuesAnotherIsNoOptionOfIt) {
  EXPECT_EQ(lacking("MAT_RIGID_DISCRETE"), "this material (MAT_220)");
  EXPECT_EQ(lacking("MAT_RIGID_FOO"), "this option (_FOO)");
}

TEST(Families, SlipsOfThePenAreUnknown) {
  EXPECT_EQ(lacking("MAT_NUL"), "");
  EXPECT_EQ(hint("MAT_NUL"), "did you mean *MAT_NULL?");
  EXPECT_EQ(lacking("CONTROL_SHP"), "");
  EXPECT_EQ(hint("CONTROL_SHP"), "did you mean *CONTROL_SPH?");
  EXPECT_EQ(hint("ELEMENT_SOLDI"), "did you mean *ELEMENT_SOLID?");
  EXPECT_EQ(hint("NODES"), "did you mean *NODE?");
}

TEST(Families, RealNamesNearToOthersAreNoSlips) {
  EXPECT_EQ(families().slip("LOAD_BODY_RX", 2), "");
  EXPECT_EQ(families().slip("LOAD_BDY_X", 2), "did you mean *LOAD_BODY_X?");
  EXPECT_EQ(lacking("LOAD_BODY_RX"), "rotational body loads");
}

TEST(Families, OptionsOfSupportedKeywordsAreNamed) {
  EXPECT_EQ(lacking("SECTION_SPH_ELLIPSE"), "this option (_ELLIPSE)");
  EXPECT_EQ(hint("SECTION_SPH_ELLIPSE"), "*SECTION_SPH is supported, its option _ELLIPSE is not");
  EXPECT_EQ(lacking("PART_MODES"), "flexible bodies by modes");  // more exact than an option of *PART
}

TEST(Families, HintListsSupportedOnesOfTheFamily) {
  EXPECT_EQ(hint("CONTACT_AUTOMATIC_SINGLE_SURFACE"), "supported: *CONTACT_AUTOMATIC_NODES_TO_SURFACE");
  EXPECT_EQ(hint("AIRBAG_ALE"), "");
}

TEST(Families, UnknownNamesAreUnknown) {
  EXPECT_EQ(lacking("COFFEE_BREAK"), "");
  EXPECT_EQ(hint("COFFEE_BREAK"), "`courant keywords` lists the supported keywords");
  EXPECT_EQ(hint("CONTORL_SPH"), "did you mean *CONTROL_SPH?");
  EXPECT_EQ(lacking(""), "");
}

TEST(Families, OutputRequests) {
  EXPECT_TRUE(is_output_request("DATABASE_NODOUT"));
  EXPECT_TRUE(is_output_request("CONTROL_MPP_DECOMPOSITION_AUTO"));
  EXPECT_FALSE(is_output_request("DATABASES"));
  EXPECT_FALSE(is_output_request("CONTROL_SPH"));
}

TEST(LawNames, NumbersAndNamesComplementEachOther) {
  std::vector<std::string> names = {"MAT_ELASTIC_FLUID"};
  add_law_names(names);
  EXPECT_EQ(names, (std::vector<std::string>{"MAT_ELASTIC_FLUID", "MAT_001_FLUID"}));
  names = {"EOS_GRUNEISEN", "EOS_004"};
  add_law_names(names);
  EXPECT_EQ(names, (std::vector<std::string>{"EOS_GRUNEISEN", "EOS_004"}));
  names = {"CONTROL_SPH"};
  add_law_names(names);
  EXPECT_EQ(names.size(), 1u);
}

TEST(LawNames, EverySupportedLawHasItsNumber) {
  for (const auto& spec : keyword_registry())
    if (const LawName* law = find_law(spec->names[0]))
      EXPECT_TRUE(std::any_of(spec->names.begin(), spec->names.end(),
                              [](const std::string& name) { return has_law_number(name); }))
          << spec->names[0] << " is number " << law->number;
}

}  // namespace

}  // namespace courant

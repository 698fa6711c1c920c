#pragma once
// The cards that give mass, centre, inertia and initial velocity of a rigid body.
#include <vector>

#include "keyword/common_rules.hpp"
#include "keyword/registry.hpp"
#include "model/mesh/part_inertia.hpp"

namespace courant {

/// T: PartInertiaCard, or what derives from it. The last card is there with IRCS 1 alone, which the caller
/// says. `system`: name of the field of a coordinate system.
template <class T>
std::vector<CardOf<T>> inertia_cards(const char* system) {
  return {{.fields = {{"XC", &T::xc, "L", "centre of mass, without NODEID", rules::point},
                      {"YC", &T::yc, "L", "centre of mass"},
                      {"ZC", &T::zc, "L", "centre of mass"},
                      {"TM", &T::tm, "M", "mass", rules::required_positive},
                      {"IRCS",
                       &T::ircs,
                       "-",
                       "axes of the inertia: 0 global, 1 those of the last card",
                       {.allowed = {0, 1}}},
                      {"NODEID", &T::nodeid, "-", "node at the centre of mass",
                       rules::optional_id_of(IdSpace::node)}}},
          {.fields = {{"IXX", &T::ixx, "ML2", "of the tensor about the centre", rules::required_positive},
                      {"IXY", &T::ixy, "ML2", "of the tensor about the centre"},
                      {"IXZ", &T::ixz, "ML2", "of the tensor about the centre"},
                      {"IYY", &T::iyy, "ML2", "of the tensor about the centre", rules::required_positive},
                      {"IYZ", &T::iyz, "ML2", "of the tensor about the centre"},
                      {"IZZ", &T::izz, "ML2", "of the tensor about the centre", rules::required_positive}}},
          {.fields = {{"VTX", &T::vtx, "L/T", "initial velocity of the centre", rules::direction},
                      {"VTY", &T::vty, "L/T", "initial velocity of the centre"},
                      {"VTZ", &T::vtz, "L/T", "initial velocity of the centre"},
                      {"VRX", &T::vrx, "1/T", "initial angular velocity, global axes", rules::direction},
                      {"VRY", &T::vry, "1/T", "initial angular velocity"},
                      {"VRZ", &T::vrz, "1/T", "initial angular velocity"}}},
          {.fields = {{"XL", &T::xl, "-", "vector along the local x axis", rules::direction},
                      {"YL", &T::yl, "-", "vector along the local x axis"},
                      {"ZL", &T::zl, "-", "vector along the local x axis"},
                      {"XLIP", &T::xlip, "-", "vector in the local xy plane", rules::direction},
                      {"YLIP", &T::ylip, "-", "vector in the local xy plane"},
                      {"ZLIP", &T::zlip, "-", "vector in the local xy plane"},
                      {system, &T::cid, "-", "system whose axes they are, instead",
                       rules::optional_id_of(IdSpace::coordinate_system)}}}};
}

}  // namespace courant

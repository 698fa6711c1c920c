#pragma once
#include "base/real.hpp"

namespace courant {

/// How the entries of a group stand in its list, from its start on:
///   members of the group and particles that have no list (rim, images), within the support of any of it
///   [later, beyond)       particles of later groups, within the support
///   [beyond, later_end)   particles of later groups, beyond the support of all eight
///   [later_end, earlier)  particles that have no list, beyond the support
///   [earlier, earlier_beyond)  particles of earlier groups, whose lists have these pairs, too, within it
///   [earlier_beyond, end)      the same, beyond
struct ListSections {
  Index later, beyond, later_end, earlier, earlier_beyond;
};

}  // namespace courant

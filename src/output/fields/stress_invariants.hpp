#pragma once
// Numbers that are read off stress tensors.
#include <vector>

#include "output/fields/vtk_xml.hpp"

namespace courant {

/// Behind each array `stress...` of tensors (xx yy zz xy yz zx) the arrays `von_mises...`, `pressure...`
/// (minus a third of the trace) and `principal_stress...` (3, the largest first), of the same type [M/LT2].
/// Names that are there already stay as they are.
void add_stress_invariants(std::vector<VtkArray>& arrays);

}  // namespace courant

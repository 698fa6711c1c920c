#pragma once
// What the field files hold of particles and shells.
#include <vector>

#include "output/field_writer.hpp"

namespace courant {

/// Particles `which`, less those that the options leave out, in the order of their ids.
VtkDataSet particle_data(const Particles& particles, std::vector<Index> which, Real t,
                         const FieldWriterOptions& options);
/// Shells of the parts that are not left out, and all nodes.
VtkDataSet shell_data(const World& world, const FieldWriterOptions& options);

}  // namespace courant

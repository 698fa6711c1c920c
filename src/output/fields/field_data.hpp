#pragma once
// What the field files hold of particles and shells.
#include <vector>

#include "output/fields/field_writer.hpp"

namespace courant {

/// Particles `which`, less those that the options leave out, in the order of their ids.
VtkDataSet particle_data(const Particles& particles, std::vector<Index> which, Real t,
                         const FieldWriterOptions& options);
/// Shells of the parts that are not left out, and all nodes.
VtkDataSet shell_data(const World& world, const FieldWriterOptions& options);
/// Elements of the groups of parts that are not left out, and their nodes; fields that all groups have.
VtkDataSet solid_data(const World& world, const FieldWriterOptions& options);
/// Places of nodes as a file holds them: float64 where particles need that, or where `nodes` stand so far
/// from the origin that float32 could not tell them apart.
VtkArray node_places(const World& world, const std::vector<Index>& nodes, const FieldWriterOptions& options);

}  // namespace courant

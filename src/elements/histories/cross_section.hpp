#pragma once
// Cross sections: what the elements on one side of a cut do to those on the other.
#include <array>
#include <string>
#include <vector>

#include "elements/histories/element_choice.hpp"

namespace courant {

/// At t^n. With the force the elements of the section push the nodes that it counts: of a plane those behind
/// it, so that tension along its normal is positive.
struct SectionForce {
  Vec force = Vec::Zero();     ///< [ML/T2]
  Vec moment = Vec::Zero();    ///< about the centroid [ML2/T2]
  Vec centroid = Vec::Zero();  ///< of the cut through the elements, which moves with them [L]
  Real area = 0;               ///< of solids, of shells with their thickness, of beams [L2]
};

/// A plane, or a piece of it.
struct CuttingPlane {
  Vec origin = Vec::Zero(), normal = Vec::UnitX(), edge = Vec::UnitY();  ///< [L]; unit vectors
  Real radius = 0;  ///< of a disc around the origin; 0: none [L]
  Real length_l = 0,
       length_m = 0;  ///< of a rectangle from the origin along `edge` and normal x edge; 0: no end
  bool contains(const Vec& point, Real tolerance) const;
};

class CrossSection {
 public:
  /// Elements that the plane cuts as they stand now and whose whole cut lies on it. Nodes on the plane count
  /// as behind it.
  CrossSection(const std::vector<ReportedElement>& elements, const CuttingPlane& plane, const World& world);
  /// Those elements, and `nodes` of the world, sorted, on which they act.
  CrossSection(const std::vector<ReportedElement>& elements, const std::vector<Index>& nodes,
               const World& world);
  bool empty() const { return cuts_.empty(); }
  SectionForce force(const World& world) const;
  /// Those that are cut.
  std::vector<ReportedElement> elements() const;

  Vec normal = Vec::Zero();  ///< of the plane at the start; 0: of a section by sets
  Id id = 0;
  std::string title{};
  Id system = 0;                     ///< of the axes below; 0: global
  Matrix axes = Matrix::Identity();  ///< as columns, in which force and moment are reported

 private:
  /// A point on the edge between two nodes, at a share of the path.
  struct CutPoint {
    Index a, b;
    Real share;
    bool operator==(const CutPoint&) const = default;
    Vec at(const World& world) const;
  };
  struct Cut {
    ReportedElement element{};
    unsigned counted = 0;  ///< bits of corners
    std::vector<CutPoint> points{};
  };
  template <class Side, class Share>
  void add(const ReportedElement& element, const World& world, const Side& counts, const Share& share);
  void add_measure(const Cut& cut, const World& world, SectionForce& sum) const;
  std::vector<Cut> cuts_;
};

}  // namespace courant

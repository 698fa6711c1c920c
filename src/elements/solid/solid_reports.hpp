#pragma once
// What solids of a part report: energies, states of elements, sums over the part.
#include <memory>
#include <vector>

#include "elements/element_report.hpp"
#include "elements/point_strains.hpp"
#include "elements/solid/full_points.hpp"
#include "elements/solid/solids.hpp"
#include "state/reports.hpp"

namespace courant {

/// The state of a group, as its forces (solid_forces.cpp) advance it.
class SolidReports : public EnergyTerm, public PartReporter, public ElementReporter, public FieldFiller {
 public:
  ElementKind kind() const override { return ElementKind::solid; }
  const ElementGroup& reported() const override { return group_; }
  Real cut_measure(Index) const override { return 1; }
  ElementReport report_element(const World&, Index e, const ElementReportOptions& options) const override {
    ElementReport out{.deleted = erosion_ && erosion_->dead(e)};
    if (full_) {
      out.points = full_->report(e, options.all_points, strains_.get());
    } else {
      PointReport& point = out.points.emplace_back();
      for (int k = 0; k < 6; ++k) point.stress[static_cast<std::size_t>(k)] = stress_.data(k)[e];
      for (const Field<Real>* h : history_)
        for (int k = 0; k < h->info().components; ++k) point.history.push_back(h->data(k)[e]);
      if (strains_) point.strain = strains_->at(0, e);
    }
    if (const int plastic = plastic_strain_of(*law_); plastic >= 0)
      for (PointReport& point : out.points) point.plastic = point.history[static_cast<std::size_t>(plastic)];
    return out;
  }
  void fill_fields(World&) override {
    if (full_) full_->average(stress_, history_);
  }
  void record(World&, const Clock&, EnergyLedger&) override {}
  void sample(const World&, const Clock&, EnergyLedger& ledger) const override {
    ledger.internal += total(internal_), ledger.bulk_viscosity += total(bulk_viscosity_);
    ledger.hourglass += total(hourglass_), ledger.assumed_bending += assumed_bending();
  }
  /// Hourglass energy that is of bending: of elements that have not flowed, by forces as the material's.
  Real assumed_bending() const {
    if (control_.hourglass != 6 || control_.QM != 1) return 0;
    const int flow = plastic_strain_of(*law_);
    const Field<Real>* plastic = flow < 0 ? nullptr : history_[static_cast<std::size_t>(flow)];
    const auto at = [&](Index e) { return plastic && (*plastic)[e] > 0 ? 0 : hourglass_[e]; };
    return sum(group_.size(), [&](Index e) { return erosion_ && erosion_->dead(e) ? 0 : at(e); });
  }
  void report_part(const World& world, std::vector<PartSums>& parts) const override {
    PartSums& out = parts[static_cast<std::size_t>(group_.part)];
    out.internal += total(internal_) + total(bulk_viscosity_);
    out.hourglass += total(hourglass_);
    if (erosion_) {
      out.eroded_internal += total_of_dead(internal_) + total_of_dead(bulk_viscosity_);
      out.eroded_hourglass += total_of_dead(hourglass_);
    }
    for (Index e = 0; e < group_.size(); ++e) {
      out.mass += group_.mass[e];
      if (scaled_) out.added_mass += scaled_->added(e);
      for (int c = 0; c < group_.corners(); ++c) {
        const Real share = scaled_ ? scaled_->of_corner(e, c) : group_.mass[e] * group_.share(e, c);
        const Vec v = world.nodes.v.vec(group_.node.data(c)[e]);
        out.momentum += share * v;
        out.kinetic += 0.5 * share * v.squaredNorm();
      }
    }
  }

 protected:
  SolidReports(const SolidPart& part, const ElementGroup& group)
      : group_(group),
        material_(part),
        law_(part.law),
        stress_(group.fields.add<Real>({.name = "stress",
                                        .dimension = "M/LT2",
                                        .components = 6,
                                        .output = true,
                                        .restart = part.formulation->points == 1})),
        internal_(group.fields.add<Real>({.name = "internal_energy", .dimension = "ML2/T2", .output = true})),
        hourglass_(
            group.fields.add<Real>({.name = "hourglass_energy", .dimension = "ML2/T2", .output = true})),
        bulk_viscosity_(group.fields.add<Real>({.name = "bulk_viscosity_energy", .dimension = "ML2/T2"})) {}
  Real total(const Field<Real>& field) const {
    return sum(group_.size(), [&](Index e) { return erosion_ && erosion_->dead(e) ? 0 : field[e]; });
  }
  Real total_of_dead(const Field<Real>& field) const {
    return sum(group_.size(), [&](Index e) { return erosion_->dead(e) ? field[e] : 0; });
  }

  const ElementGroup& group_;
  SolidPart material_;
  std::shared_ptr<StrengthLaw> law_;
  SolidControl control_;
  Field<Real>&stress_, &internal_, &hourglass_, &bulk_viscosity_;
  std::vector<Field<Real>*> history_;
  std::unique_ptr<FullPoints> full_;       ///< null: elements have one point
  std::unique_ptr<ScaledMass> scaled_;     ///< null: no mass scaling
  std::shared_ptr<Erosion> erosion_;       ///< null: nothing fails
  std::unique_ptr<PointStrains> strains_;  ///< null: not requested
};

}  // namespace courant

#pragma once
// Functions of the volumetric strain, as cards of equations of state give them by points or curves.
#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "keyword/deck.hpp"
#include "laws/eos/eos_cards.hpp"
#include "model/model.hpp"

namespace courant {

/// Straight between points and beyond the last. The strain is ln(rho/RO) = -ln V, > 0 in compression.
class VolumeTable {
 public:
  VolumeTable() = default;
  /// `strain` rising, as many as values. Of less than two points the function is 0.
  VolumeTable(std::vector<Real> strain, std::vector<Real> value)
      : strain_(std::move(strain)), value_(std::move(value)) {}
  Real operator()(Real strain) const;
  Real slope(Real strain) const;
  /// The same, but constant before the first point and beyond the last.
  Real held(Real strain) const {
    return known() ? (*this)(std::clamp(strain, strain_.front(), strain_.back())) : 0;
  }
  const std::vector<Real>& strain() const { return strain_; }
  const std::vector<Real>& value() const { return value_; }
  bool is_zero() const;

 private:
  bool known() const { return strain_.size() >= 2; }
  /// Of the piece that begins there.
  Real slope_of(std::size_t k) const { return (value_[k + 1] - value_[k]) / (strain_[k + 1] - strain_[k]); }
  std::size_t piece(Real strain) const;
  std::vector<Real> strain_, value_;
};

/// What the cards of *EOS_TABULATED and *EOS_TABULATED_COMPACTION share.
struct VolumePoints : VolumePointsFields {
  Real e0() const { return E0; }
  Real v0() const { return V0; }

  using Column = std::array<Real, 10>;
  Column ev() const { return {ev1, ev2, ev3, ev4, ev5, ev6, ev7, ev8, ev9, ev10}; }
  Column c() const { return {c1, c2, c3, c4, c5, c6, c7, c8, c9, c10}; }
  Column t() const { return {t1, t2, t3, t4, t5, t6, t7, t8, t9, t10}; }
};

/// Of curve `id`, whose abscissa is the strain, or where it is 0 of a column over EV1 to EV10, of which
/// `columns` are all: where those are 0 behind the last point, there is none.
VolumeTable volume_table(const Model& model, Id id, const VolumePoints& points,
                         std::initializer_list<VolumePoints::Column> columns,
                         const VolumePoints::Column& column);
/// Whether the points, or those of the curve in `field`, make a function; an error where not.
bool check_volume_table(const Deck& deck, const Entry& card, const char* field, Id id,
                        const VolumeTable& table, Diagnostics& diagnostics);

/// What *EOS_TABULATED_COMPACTION gives over -ln V: the pressure of first loading C and the bulk modulus of
/// unloading K [M/LT2]; `cold`: neither energy nor V0 is in it.
struct CompactionCurves {
  VolumeTable C, K;
  bool cold = true;
};
/// Of the card with this id; none: there is no such card.
std::optional<CompactionCurves> compaction_curves(const Deck& deck, const Model& model, Id eosid);

}  // namespace courant

#pragma once
// Functions of the volumetric strain, as cards of equations of state give them by points or curves.
#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

#include "keyword/common_rules.hpp"
#include "keyword/deck.hpp"
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
struct VolumePoints : Entry {
  Id eosid = 0, lcc = 0, lct = 0;
  Real gama = 0, E0 = 0, V0 = 1;
  Real ev1 = 0, ev2 = 0, ev3 = 0, ev4 = 0, ev5 = 0, ev6 = 0, ev7 = 0, ev8 = 0, ev9 = 0, ev10 = 0;
  Real c1 = 0, c2 = 0, c3 = 0, c4 = 0, c5 = 0, c6 = 0, c7 = 0, c8 = 0, c9 = 0, c10 = 0;
  Real t1 = 0, t2 = 0, t3 = 0, t4 = 0, t5 = 0, t6 = 0, t7 = 0, t8 = 0, t9 = 0, t10 = 0;
  std::string title;
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

inline constexpr FieldRules in_wide_columns{.width = 16};

/// The fields that those cards share.
template <class Card>
struct VolumeFields {
  static FieldOf<Card> gama() { return {"GAMA", &Card::gama, "-", "factor of T E", {}}; }
  static FieldOf<Card> e0() {
    return {"E0", &Card::E0, "M/LT2", "initial internal energy per reference volume", {}};
  }
  static FieldOf<Card> lcc() {
    return {"LCC", &Card::lcc, "-", "curve of C over -ln V instead of points",
            rules::optional_id_of(IdSpace::curve)};
  }
  static FieldOf<Card> lct() {
    return {"LCT", &Card::lct, "-", "curve of T over -ln V instead of points",
            rules::optional_id_of(IdSpace::curve)};
  }
  /// Cards of EV, C and T.
  static std::vector<CardOf<Card>> points() {
    return {{.fields = {{"EV1", &Card::ev1, "-", "ln(V) of point 1, < 0 in compression", in_wide_columns},
                        {"EV2", &Card::ev2, "-", "ln(V) of point 2, < 0 in compression", in_wide_columns},
                        {"EV3", &Card::ev3, "-", "ln(V) of point 3, < 0 in compression", in_wide_columns},
                        {"EV4", &Card::ev4, "-", "ln(V) of point 4, < 0 in compression", in_wide_columns},
                        {"EV5", &Card::ev5, "-", "ln(V) of point 5, < 0 in compression", in_wide_columns}},
             .optional = true},
            {.fields = {{"EV6", &Card::ev6, "-", "ln(V) of point 6, < 0 in compression", in_wide_columns},
                        {"EV7", &Card::ev7, "-", "ln(V) of point 7, < 0 in compression", in_wide_columns},
                        {"EV8", &Card::ev8, "-", "ln(V) of point 8, < 0 in compression", in_wide_columns},
                        {"EV9", &Card::ev9, "-", "ln(V) of point 9, < 0 in compression", in_wide_columns},
                        {"EV10", &Card::ev10, "-", "ln(V) of point 10, < 0 in compression", in_wide_columns}},
             .optional = true},
            {.fields = {{"C1", &Card::c1, "M/LT2", "pressure without energy at EV1", in_wide_columns},
                        {"C2", &Card::c2, "M/LT2", "pressure without energy at EV2", in_wide_columns},
                        {"C3", &Card::c3, "M/LT2", "pressure without energy at EV3", in_wide_columns},
                        {"C4", &Card::c4, "M/LT2", "pressure without energy at EV4", in_wide_columns},
                        {"C5", &Card::c5, "M/LT2", "pressure without energy at EV5", in_wide_columns}},
             .optional = true},
            {.fields = {{"C6", &Card::c6, "M/LT2", "pressure without energy at EV6", in_wide_columns},
                        {"C7", &Card::c7, "M/LT2", "pressure without energy at EV7", in_wide_columns},
                        {"C8", &Card::c8, "M/LT2", "pressure without energy at EV8", in_wide_columns},
                        {"C9", &Card::c9, "M/LT2", "pressure without energy at EV9", in_wide_columns},
                        {"C10", &Card::c10, "M/LT2", "pressure without energy at EV10", in_wide_columns}},
             .optional = true},
            {.fields = {{"T1", &Card::t1, "-", "factor of GAMA E at EV1", in_wide_columns},
                        {"T2", &Card::t2, "-", "factor of GAMA E at EV2", in_wide_columns},
                        {"T3", &Card::t3, "-", "factor of GAMA E at EV3", in_wide_columns},
                        {"T4", &Card::t4, "-", "factor of GAMA E at EV4", in_wide_columns},
                        {"T5", &Card::t5, "-", "factor of GAMA E at EV5", in_wide_columns}},
             .optional = true},
            {.fields = {{"T6", &Card::t6, "-", "factor of GAMA E at EV6", in_wide_columns},
                        {"T7", &Card::t7, "-", "factor of GAMA E at EV7", in_wide_columns},
                        {"T8", &Card::t8, "-", "factor of GAMA E at EV8", in_wide_columns},
                        {"T9", &Card::t9, "-", "factor of GAMA E at EV9", in_wide_columns},
                        {"T10", &Card::t10, "-", "factor of GAMA E at EV10", in_wide_columns}},
             .optional = true}};
  }
};

}  // namespace courant

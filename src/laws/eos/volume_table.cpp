#include "laws/eos/volume_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace courant {

std::size_t VolumeTable::piece(Real strain) const {
  const auto after = std::lower_bound(strain_.begin() + 1, strain_.end() - 1, strain);
  return static_cast<std::size_t>(after - strain_.begin()) - 1;
}

Real VolumeTable::operator()(Real strain) const {
  if (!known()) return 0;
  const std::size_t k = piece(strain);
  return value_[k] + slope_of(k) * (strain - strain_[k]);
}

Real VolumeTable::slope(Real strain) const {
  return known() ? slope_of(piece(strain)) : 0;
}

bool VolumeTable::is_zero() const {
  return std::all_of(value_.begin(), value_.end(), [](Real y) { return y == 0; });
}

namespace {

/// Zeros behind the last point are blank fields, but for the first of them where strains rise towards 0.
std::size_t points_of(const VolumePoints::Column& ev, std::initializer_list<VolumePoints::Column> columns) {
  std::size_t n = ev.size();
  const auto blank = [&](std::size_t k) {
    return ev[k] == 0 &&
           std::all_of(columns.begin(), columns.end(), [&](const auto& c) { return c[k] == 0; });
  };
  while (n > 0 && blank(n - 1)) --n;
  const bool rises_to_0 = n > 0 && n < ev.size() && ev[n - 1] < 0 && (n == 1 || ev[n - 1] > ev[n - 2]);
  return rises_to_0 ? n + 1 : n;
}

}  // namespace

VolumeTable volume_table(const Model& model, Id id, const VolumePoints& points,
                         std::initializer_list<VolumePoints::Column> columns,
                         const VolumePoints::Column& column) {
  if (id != 0) {
    const auto curve = model.curves.find(id);
    if (curve == model.curves.end()) return {};
    return {curve->second.abscissa, curve->second.ordinate};
  }
  const VolumePoints::Column ev = points.ev();
  const std::size_t n = points_of(ev, columns);
  std::vector<Real> strain, value(column.begin(), column.begin() + n);
  for (std::size_t k = 0; k < n; ++k) strain.push_back(-ev[k]);
  if (n > 1 && strain[1] < strain[0])
    std::reverse(strain.begin(), strain.end()), std::reverse(value.begin(), value.end());
  return {std::move(strain), std::move(value)};
}

bool check_volume_table(const Deck& deck, const Entry& card, const char* field, Id id,
                        const VolumeTable& table, Diagnostics& diagnostics) {
  const auto& strain = table.strain();
  if (id != 0) {
    if (strain.size() >= 2) return true;
    deck.error(diagnostics, card, field, fmt::format("curve {} needs at least two points", id),
               "it gives its values over -ln(V), which rises in compression");
    return false;
  }
  const char* hint = "give at least two points, from expansion (EV > 0) to compression (EV < 0)";
  if (strain.size() < 2) {
    deck.error(diagnostics, card, "EV2", "expected at least two points", hint);
    return false;
  }
  for (std::size_t k = 1; k < strain.size(); ++k) {
    if (strain[k] > strain[k - 1]) continue;
    deck.error(diagnostics, card, "EV2",
               fmt::format("expected strains that all rise or all fall, got '{:g}' beside '{:g}'",
                           0 - strain[k], 0 - strain[k - 1]),
               hint);
    return false;
  }
  return true;
}

}  // namespace courant

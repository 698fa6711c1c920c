#include "elements/shell/hourglass_shell.hpp"

#include <fmt/format.h>

namespace courant {

namespace {

constexpr int last_viscous_kind = 3, last_common_kind = 5, last_stiffness_kind = 6, last_kind = 10;
constexpr Real usual_drilling = 0.01;  ///< of G t (A + t^2)/4: much more stiffens coarse meshes
constexpr Real usual_coefficient = 0.1;
constexpr Real largest_advised = 0.15;  ///< LS-DYNA's advice: above it hourglass forces may be unstable

}  // namespace

ShellHourglassReader::ShellHourglassReader(const Deck& deck)
    : deck_(deck), control_(deck.last<ControlHourglass>()), bulk_(deck.last<ControlBulkViscosity>()) {
  for (const Hourglass& card : deck.all<Hourglass>()) cards_.emplace(card.hgid, &card);
}

void ShellHourglassReader::read(const ModelPart& part, bool full, ShellControl& out,
                                Diagnostics& diagnostics) {
  if (full || out.warps) out.drilling = usual_drilling;
  const Hourglass* card = nullptr;
  if (part.hgid != 0) {
    const auto found = cards_.find(part.hgid);
    if (found == cards_.end()) {
      deck_.error(diagnostics, part.card, "HGID", fmt::format("hourglass {} does not exist", part.hgid),
                  "define it with *HOURGLASS, or leave the field blank");
      return;
    }
    card = found->second;
  }
  const bool own_kind = card && card->ihq != 0;
  Real QM = usual_coefficient;
  if (own_kind) {
    take_kind(*card, card->ihq, part, full, out, diagnostics);
  } else if (control_) {
    if (control_->ihq != 0) take_kind(*control_, control_->ihq, part, full, out, diagnostics);
    QM = control_->qh;
    check(*control_, "QH", QM, diagnostics);
  }
  if (card && card->qm != 0) QM = card->qm, check(*card, "QM", QM, diagnostics);
  out.QM = out.QB = out.QW = QM;
  if (card && card->qb != 0) out.QB = card->qb, check(*card, "QB/VDC", out.QB, diagnostics);
  if (card && card->qw != 0) out.QW = card->qw, check(*card, "QW", out.QW, diagnostics);
  if (!bulk_ || bulk_->type >= 0) return;
  out.Q1 = card ? card->q1 : bulk_->q1, out.Q2 = card ? card->q2 : bulk_->q2;
}

void ShellHourglassReader::take_kind(const Entry& card, int ihq, const ModelPart& part, bool full,
                                     ShellControl& out, Diagnostics& diagnostics) {
  if (full && ihq > last_common_kind) return;  // of other elements, or 8, which is usual
  if (full) out.drilling = 0;
  out.stiffness = ihq > last_viscous_kind;
  if (full || (ihq > 0 && ihq <= last_stiffness_kind) || !told_.insert({&card, "IHQ"}).second) return;
  if (ihq > last_stiffness_kind && ihq <= last_kind) {
    deck_.warning(
        diagnostics, card, "IHQ",
        fmt::format("{} is of other elements: the shells of part {} take 4 (stiffness)", ihq, part.id),
        "give their part a *HOURGLASS of its own");
  } else {
    deck_.refuse(diagnostics, card, "IHQ",
                 fmt::format("'{}' is not supported for shells, as those of part {}", ihq, part.id),
                 "supported values: 0, 1 to 3 (viscous), 4 to 10 (stiffness; 8 with ELFORM 16: of warping)");
  }
}

void ShellHourglassReader::check(const Entry& card, const char* field, Real value, Diagnostics& diagnostics) {
  if (value >= 0 && value <= largest_advised) return;
  if (!told_.insert({&card, field}).second) return;
  if (value < 0)
    deck_.error(diagnostics, card, field, fmt::format("expected a number >= 0, got '{:g}'", value));
  else
    deck_.warning(
        diagnostics, card, field,
        fmt::format("hourglass control of shells with a coefficient of {:g} may be unstable", value),
        fmt::format("keep it at {:g} or below", largest_advised));
}

}  // namespace courant

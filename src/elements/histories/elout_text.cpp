#include "elements/histories/elout_text.hpp"

#include <fmt/printf.h>

#include <algorithm>
#include <cmath>

namespace courant {
namespace {

using Elements = std::vector<EloutElement>;

const char* state_of(const ElementReport& element, const PointReport& point) {
  return element.deleted ? "failed" : point.plastic > 0 ? "plastic" : "elastic";
}

std::string six(const std::array<Real, 6>& values) {
  std::string out;
  for (const Real value : values) out += fmt::sprintf("%12.4E", value + 0.0);  // no -0
  return out;
}

std::string heading(const char* what, const Clock& clock) {
  return fmt::sprintf(
      "\n\n\n e l e m e n t   %s   c a l c u l a t i o n s   f o r   t i m e  s t e p%9d   ( at time %12.5E "
      ")\n",
      what, clock.cycle, clock.t);
}

std::string solids_text(const Elements& elements, const Clock& clock) {
  std::string out = heading("s t r e s s", clock);
  out += "\n element  materl\n";
  out +=
      "     ipt  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx           "
      "            yield\n";
  out += fmt::format("           state{:82}effsg      function\n", "");
  for (const EloutElement& one : elements) {
    out += fmt::sprintf("%8d-%7d\n", one.id, one.part);
    int number = 0;
    for (const PointReport& point : one.report.points)
      out += fmt::sprintf("%8d %-7s %s%14.4E%14.4E\n", ++number, state_of(one.report, point),
                          six(point.stress), effective_stress(point.stress), point.plastic);
  }
  return out;
}

std::string shells_text(const Elements& elements, const Clock& clock, bool local) {
  std::string out = heading("s t r e s s", clock);
  out += local ? "\n element  materl(local) \n" : "\n element  materl(global)\n";
  out +=
      " ipt-shl  stress       sig-xx      sig-yy      sig-zz      sig-xy      sig-yz      sig-zx       "
      "plastic\n";
  out += fmt::format("           state{:81}strain \n", "");
  for (const EloutElement& one : elements) {
    out += fmt::sprintf("%8d-%7d\n", one.id, one.part);
    int number = 0;
    for (const PointReport& point : one.report.points)
      out += fmt::sprintf("%4d-%3d %-7s %s%14.4E\n", ++number, 1, state_of(one.report, point),
                          six(point.stress), point.plastic);
  }
  return out;
}

std::string beams_text(const Elements& elements, const Clock& clock) {
  std::string out = fmt::sprintf(
      "\n\n\n\n r e s u l t a n t s   a n d   s t r e s s e s   f o r   t i m e  s t e p%9d   ( at "
      "time%12.5E )\n",
      clock.cycle, clock.t);
  for (const EloutElement& one : elements) {
    out += fmt::sprintf("\n\n beam/truss # =%8d      part ID  =%10d      material type=%8d\n", one.id,
                        one.part, one.material);
    out += "\n resultants      axial    shear-s    shear-t    moment-s   moment-t   torsion\n           ";
    for (const Real value : one.report.resultants) out += fmt::sprintf("%11.3E", value + 0.0);
    out += "\n";
    if (one.report.points.empty()) continue;
    out +=
        "\n\n integration point stresses\n                       sigma 11       sigma 12       sigma 31   "
        "plastic  eps\n";
    int number = 0;
    for (const PointReport& point : one.report.points)
      out += fmt::sprintf("%5d           %15.6E%15.6E%15.6E%15.6E\n", ++number, point.stress[0] + 0.0,
                          point.stress[3] + 0.0, point.stress[5] + 0.0, point.plastic);
  }
  return out;
}

/// Eight numbers a line.
std::string history_of_point(const ElementReport& element, const PointReport& point, int number, int count) {
  std::string out;
  for (int first = 0; first < count; first += 8) {
    out += fmt::sprintf("%8d %-7s ", number, state_of(element, point));
    const int end = std::min({count, first + 8, static_cast<int>(point.history.size())});
    for (int k = first; k < end; ++k)
      out += fmt::sprintf("%12.4E", point.history[static_cast<std::size_t>(k)] + 0.0);
    out += "\n";
  }
  return out;
}

std::string text_with_history(const char* kind, const Elements& elements, const Clock& clock, int history) {
  const std::string owner = fmt::format(" element part ID   ({})\n", kind);
  std::string out = heading("s t r e s s", clock) + owner;
  out +=
      "     ipt  stress    stress-xx   stress-yy   stress-zz   stress-xy   stress-yz   stress-zx           "
      "            yield\n";
  out += fmt::format("           state{:82}effsg      function\n", "");
  std::string histories = heading("h i s t r y", clock) + owner;
  histories +=
      "     ipt            history 1   history 2   history 3   history 4   history 5   history 6   "
      "history 7   history 8\n";
  for (const EloutElement& one : elements) {
    const std::string name = fmt::sprintf("%8d-%7d\n", one.id, one.part);
    out += name, histories += name;
    int number = 0;
    for (const PointReport& point : one.report.points) {
      out += fmt::sprintf("%8d %-7s %s%14.4E%14.4E\n", ++number, state_of(one.report, point),
                          six(point.stress), effective_stress(point.stress), point.plastic);
      histories += history_of_point(one.report, point, number, history);
    }
  }
  return out + histories;
}

std::string resultants_text(const Elements& elements, const Clock& clock) {
  std::string out = fmt::sprintf(
      "\n\n\n e l e m e n t   s t r e s s   r e s u l t a n t s       f o r   t i m e  s t e p%9d   ( at "
      "time %12.5E )\n",
      clock.cycle, clock.t);
  out +=
      " element part ID   (beam)\n                        axial     shear-s     shear-t    moment-s    "
      "moment-t      torsion\n";
  for (const EloutElement& one : elements)
    out += fmt::sprintf("%8d-%7d\n      resultants %s\n", one.id, one.part, six(one.report.resultants));
  return out;
}

std::string solid_strains_text(const Elements& elements, const Clock& clock) {
  std::string out = heading("s t r a i n", clock);
  out +=
      "\n element  materl\n element  strain       eps-xx      eps-yy      eps-zz      eps-xy      eps-yz     "
      " "
      "eps-zx\n num/ipt   state\n";
  for (const EloutElement& one : elements) {
    out += fmt::sprintf("%8d-%7d\n", one.id, one.part);
    int number = 0;
    for (const PointReport& point : one.report.points)
      out += fmt::sprintf("%8d %-7s %s\n", ++number, state_of(one.report, point), six(point.strain));
  }
  return out;
}

std::string shell_strains_text(const Elements& elements, bool local) {
  std::string out =
      fmt::format("\n strains {:8}      eps-xx      eps-yy      eps-zz", local ? "(local)" : "(global)");
  out += "      eps-xy      eps-yz      eps-zx\n\n";
  for (const EloutElement& one : elements)
    if (!one.report.points.empty())
      out += fmt::sprintf("%8d-%7d\n lower surface   %s\n upper surface   %s\n", one.id, one.part,
                          six(one.report.points.front().strain), six(one.report.points.back().strain));
  return out;
}

std::string stress_text(ElementKind kind, const Elements& elements, const Clock& clock,
                        const EloutContent& content) {
  const int history = content.history;
  switch (kind) {
    case ElementKind::solid:
      return history > 0 ? text_with_history("solid", elements, clock, history)
                         : solids_text(elements, clock);
    case ElementKind::beam:
      return history > 0
                 ? text_with_history("beam", elements, clock, history) + resultants_text(elements, clock)
                 : beams_text(elements, clock);
    case ElementKind::shell:
      break;
  }
  return history > 0 ? text_with_history("shell", elements, clock, history)
                     : shells_text(elements, clock, content.local);
}

}  // namespace

Real effective_stress(const std::array<Real, 6>& s) {
  const Real a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

std::string elout_text(ElementKind kind, const Elements& elements, const Clock& clock,
                       const EloutContent& content) {
  std::string out = stress_text(kind, elements, clock, content);
  if (content.strains && kind == ElementKind::solid) out += solid_strains_text(elements, clock);
  if (content.strains && kind == ElementKind::shell) out += shell_strains_text(elements, content.local);
  return out;
}

}  // namespace courant

// *COURANT_KERNEL, and what kernel a deck asks for.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "keyword/registry.hpp"
#include "sph/cards.hpp"
#include "sph/kernel/kernel_cards.hpp"
#include "sph/sph.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantKernel> kernel_keyword{courant_kernel_table()};

/// The kernel that SPHKERN gives all SPH parts.
KernelChoice kernel_of_sections(const Deck& deck, const Model& model, Diagnostics& diagnostics,
                                const SectionSph** first) {
  const ModelPart* first_part = nullptr;
  for (const ModelPart& part : model.parts) {
    if (!part.has_sph) continue;
    for (const SectionSph& s : deck.all<SectionSph>()) {
      if (s.secid != part.secid) continue;
      if (*first == nullptr) {
        *first = &s, first_part = &part;
      } else if (s.sphkern != (*first)->sphkern) {
        deck.error(diagnostics, s, "SPHKERN",
                   fmt::format("part {} has the {}, part {} the {}: particles of all parts are neighbours "
                               "and need one kernel",
                               part.id, kernel_name(static_cast<KernelChoice>(s.sphkern)), first_part->id,
                               kernel_name(static_cast<KernelChoice>((*first)->sphkern))),
                   "give all *SECTION_SPH of SPH parts the same SPHKERN");
      }
    }
  }
  return *first == nullptr ? KernelChoice::cubic_spline : static_cast<KernelChoice>((*first)->sphkern);
}

}  // namespace

KernelChoice read_kernel(const Deck& deck, const Model& model, Diagnostics& diagnostics) {
  const SectionSph* section = nullptr;
  const KernelChoice of_sections = kernel_of_sections(deck, model, diagnostics, &section);
  const auto* c = deck.last<CourantKernel>();
  if (c == nullptr) return of_sections;
  if (of_sections != KernelChoice::cubic_spline)
    deck.error(diagnostics, *section, "SPHKERN",
               fmt::format("'{}' asks for the {}, *COURANT_KERNEL for {}", section->sphkern,
                           kernel_name(of_sections), c->name),
               "leave SPHKERN blank, or leave *COURANT_KERNEL out");
  std::string name = c->name;
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char a) { return std::tolower(a); });
  if (name == "wendland_c2") return KernelChoice::wendland_c2;
  if (name == "wendland_c4") return KernelChoice::wendland_c4;
  deck.error(diagnostics, *c, "NAME",
             c->name.empty() ? std::string("expected the name of a kernel, got a blank field")
                             : fmt::format("there is no kernel '{}'", c->name),
             "wendland_c2 or wendland_c4; SPHKERN of *SECTION_SPH has cubic, quintic, quadratic and quartic "
             "splines");
  return of_sections;
}

}  // namespace courant

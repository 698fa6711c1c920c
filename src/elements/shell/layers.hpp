#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "elements/shell/shell_element_cards.hpp"
#include "elements/shell/shells.hpp"
#include "elements/shell_faces/section_shell.hpp"
#include "keyword/deck.hpp"

namespace courant {

/// What is at the points through the thickness of a part: points of Gauss or Lobatto of one material,
/// with angles of their own by ICOMP 1; those of an *INTEGRATION_SHELL; the middles of the layers of a
/// *PART_COMPOSITE or of an *ELEMENT_SHELL_COMPOSITE.
class LayerReader {
 public:
  LayerReader(const Deck& deck, const Model& model, Diagnostics& diagnostics);
  /// Fills points, laws and angles. False, perhaps without a message where others give it: a material is not
  /// there, or shells cannot have it.
  bool read(const ModelPart& part, const SectionShell& section, bool lobatto, ShellPart& out);
  /// The same for shells with layers of their own, instead of those of their part.
  bool read(const ModelPart& part, const ModelLayup& layup, ShellPart& out);
  /// Null: shells cannot have it.
  std::shared_ptr<StrengthLaw> law_of(Id mid) const;

 private:
  /// Location of the materials of layers.
  struct Owner {
    const Entry& card;
    const char* field;
  };
  bool find_points(const ModelPart& part, const SectionShell& s, bool lobatto, ShellPart& out,
                   std::vector<Id>& mids);
  bool follow_rule(const ModelPart& part, const SectionShell& s, ShellPart& out, std::vector<Id>& mids);
  bool take_points(const IntegrationShell& rule, const ModelPart& part, ShellPart& out,
                   std::vector<Id>& mids);
  bool take_plies(const std::vector<ModelPly>& plies, const Owner& owner, ShellPart& out,
                  std::vector<Id>& mids);
  bool find_laws(const ModelPart& part, const Owner& owner, const std::vector<Id>& mids, ShellPart& out);
  bool refuse_erosion(const ModelPart& part, const Owner& owner, Id mid);
  bool error(const Entry& card, const char* field, std::string message, std::string hint);

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  std::map<Id, std::shared_ptr<StrengthLaw>> laws_;
  std::map<Id, const IntegrationShell*> rules_;
};

/// Rules of a part, with those of its layers.
FailureRules rules_of_layers(const ShellPart& part, FailureRules rules);

}  // namespace courant

#pragma once
// Finding the elements that histories and cross sections are to report.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "elements/element_report.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"

namespace courant {

/// An element that deforms.
struct ReportedElement {
  ElementKind kind = ElementKind::solid;
  const ElementReporter* reporter = nullptr;
  Index e = 0;  ///< of its group
  Id id() const { return reporter->reported().id[e]; }
  Index part() const { return reporter->reported().part; }
};

const char* element_word(ElementKind kind);  ///< "solid", "beam", "shell"

class ElementChoice {
 public:
  ElementChoice(const Deck& deck, const Model& model, const World& world, Diagnostics& diagnostics);
  /// The element with this id; null with an error where there is none, and with a warning that `of` does not
  /// tell of it where it is rigid.
  const ReportedElement* find(const Entry& card, const char* field, ElementKind kind, Id id, const char* of);
  /// The same of the members of a set; those that are rigid are reported once.
  std::vector<ReportedElement> set(const Entry& card, const char* field, ElementKind kind, Id id,
                                   const char* of);
  /// All elements that deform, in the order of groups.
  const std::vector<ReportedElement>& all() const { return all_; }

 private:
  std::vector<Id> members(const Entry& card, const char* field, ElementKind kind, Id id);
  bool in_model(ElementKind kind, Id id) const;

  const Deck& deck_;
  const Model& model_;
  Diagnostics& diagnostics_;
  std::vector<ReportedElement> all_;
  std::map<std::pair<ElementKind, Id>, std::size_t> at_;
};

}  // namespace courant

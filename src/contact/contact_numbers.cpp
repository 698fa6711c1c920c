#include "contact/contact_numbers.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "contact/cards.hpp"
#include "contact/nodes/transducer.hpp"
#include "contact/tied/tied_card.hpp"

namespace courant {

namespace {

constexpr int most_shown = 8;  // contacts in one message

}  // namespace

void number_contacts(Deck& deck, Diagnostics& diagnostics) {
  std::vector<ContactCard*> cards;
  for (ContactCard& card : deck.store<ContactCard>()) cards.push_back(&card);
  for (TiedCard& card : deck.store<TiedCard>()) cards.push_back(&card);
  for (TransducerCard& card : deck.store<TransducerCard>()) cards.push_back(&card);
  std::map<Id, const ContactCard*> first;
  std::vector<std::size_t> later;
  for (std::size_t k = 0; k < cards.size(); ++k)
    if (cards[k]->cid <= 0 || !first.try_emplace(cards[k]->cid, cards[k]).second) later.push_back(k);
  const ContactCard* reported = nullptr;
  std::string message;
  int repeated = 0;
  for (const std::size_t k : later) {
    ContactCard& card = *cards[k];
    const auto place = static_cast<Id>(k + 1), asked = card.cid;
    card.cid = asked <= 0 && !first.contains(place) ? place : first.rbegin()->first + 1;
    if (asked > 0 && !reported) {
      reported = &card;
      message = fmt::format("contact {} is defined already, as {} at {}: this one is {} in outputs", asked,
                            deck.keyword(*first.at(asked)), deck.place(*first.at(asked)), card.cid);
    } else if (asked > 0 && ++repeated <= most_shown) {
      const Location at = deck.where(card);
      message += fmt::format("{}{} at {}:{} is {}", repeated == 1 ? "; likewise " : ", ", asked, at.file,
                             at.line, card.cid);
    }
    first.emplace(card.cid, &card);
  }
  if (repeated > most_shown) message += fmt::format(", and {} more", repeated - most_shown);
  if (reported) deck.warning(diagnostics, *reported, "", message, "give every contact an id of its own");
}

}  // namespace courant

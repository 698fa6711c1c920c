// *PART_CONTACT: a part with data for contacts.
#include "keyword/registry.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

const RegisterKeyword<PartContactCard> part_contact{part_contact_table()};

}  // namespace

}  // namespace courant

// *CONTACT_EXAMPLE_VISCOUS_SLIP: what touches and slides is slowed in proportion to its speed, as by a film
// of oil.
#include "contact/interface_law.hpp"
#include "extension/compiled_against.hpp"
#include "keyword/registry.hpp"

namespace {

using namespace courant;

class ViscousSlip : public InterfaceLaw {
 public:
  explicit ViscousSlip(Real coeff) : coeff_(coeff) {}
  Vec force(const TouchState& touch, const Clock&) const override {
    const Vec slip = touch.velocity - touch.velocity.dot(touch.n) * touch.n;
    return -coeff_ * touch.mass * slip;
  }

 private:
  Real coeff_;
};

struct Card : Entry {
  Id cid = 0;
  Real coeff = 0;
};

const RegisterKeyword<Card> keyword{
    {.names = {"CONTACT_EXAMPLE_VISCOUS_SLIP"},
     .purpose = "force -COEFF m v on what slides over a surface with v",
     .cards = {{.fields = {{"CID",
                            &Card::cid,
                            "-",
                            "id of a *CONTACT",
                            {.required = true, .check = Check::positive, .refers = IdSpace::contact}},
                           {"COEFF",
                            &Card::coeff,
                            "1/T",
                            "slip falls as exp(-COEFF t)",
                            {.required = true, .check = Check::positive}}}}}}};

const RegisterInterfaceLaw registered{[](const Deck& deck) {
  std::vector<AskedInterfaceLaw> laws;
  for (const Card& card : deck.all<Card>())
    laws.push_back({card.cid, std::make_shared<ViscousSlip>(card.coeff), card});
  return laws;
}};

}  // namespace

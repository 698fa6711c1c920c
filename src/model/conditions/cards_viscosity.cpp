// Tables of artificial viscosity and hourglass control.
#include "keyword/registry.hpp"
#include "model/conditions/condition_cards.hpp"

namespace courant {

namespace {

const RegisterKeyword<Hourglass> hourglass{hourglass_table()};
const RegisterKeyword<ControlHourglass> control_hourglass{control_hourglass_table()};
const RegisterKeyword<ControlBulkViscosity> bulk_viscosity{control_bulk_viscosity_table()};

}  // namespace

}  // namespace courant

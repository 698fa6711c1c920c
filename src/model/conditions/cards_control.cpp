// Tables of control keywords and output requests.
#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/conditions/condition_cards.hpp"

namespace courant {

namespace {

const RegisterKeyword<ControlTerminationCard> control_termination{control_termination_table()};
const RegisterKeyword<ControlTimestepCard> control_timestep{control_timestep_table()};
const RegisterKeyword<DatabaseD3plotCard> database_binary_d3plot{database_binary_d3plot_table()};

}  // namespace

}  // namespace courant

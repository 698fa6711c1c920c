// Tables of the histories: which, how often, of whom.
#include "keyword/registry.hpp"
#include "model/cards.hpp"
#include "model/requests/request_cards.hpp"

namespace courant {

namespace {

const RegisterKeyword<DatabaseAsciiCard> database_ascii{database_glstat_table()};
const RegisterKeyword<DatabaseHistorySphCard> database_history_sph{database_history_sph_table()};
const RegisterKeyword<DatabaseHistoryNodeCard> database_history_node{database_history_node_table()};
const RegisterKeyword<SeatbeltAccelerometer> seatbelt_accelerometer{element_seatbelt_accelerometer_table()};
const RegisterKeyword<DatabaseHistoryNodeIdCard> database_history_node_id{database_history_node_id_table()};

}  // namespace

}  // namespace courant

#include "app/run/app_cards.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<DatabaseRunrsfCard> runrsf{database_binary_runrsf_table()};
const RegisterKeyword<DatabaseD3dumpCard> d3dump{database_binary_d3dump_table()};

}  // namespace

}  // namespace courant

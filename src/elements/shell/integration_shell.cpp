#include "elements/shell/shell_element_cards.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<IntegrationShell> integration_shell{integration_shell_table()};

}  // namespace

}  // namespace courant

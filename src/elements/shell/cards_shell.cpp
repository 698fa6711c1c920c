#include "elements/shell/cards_shell.hpp"
#include "elements/shell/shell_element_cards.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<ControlShell> control_shell{control_shell_table()};
const RegisterKeyword<ControlAccuracy> control_accuracy{control_accuracy_table()};

}  // namespace

}  // namespace courant

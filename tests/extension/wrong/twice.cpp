// Registers a keyword of the library.
#include "extension/compiled_against.hpp"
#include "keyword/registry.hpp"

namespace {

struct Card : courant::Entry {
  courant::Id mid = 0;
};
const courant::RegisterKeyword<Card> keyword{
    {.names = {"MAT_ELASTIC"}, .cards = {{.fields = {{"MID", &Card::mid, "-", "id"}}}}}};

}  // namespace

// Keywords that shape the deck itself. read_deck handles them by name; the tables are for the documentation.
#include "keyword/registry.hpp"

namespace courant {

namespace {

struct DeckLevel : Entry {
  std::string text;
};

const RegisterKeyword<DeckLevel> keyword_keyword{
    {.names = {"KEYWORD", "KEYWORD_ID", "KEYWORD_JOBID"},
     .purpose =
         "begins a deck; LONG=Y (all fields 20 wide) or I10=Y (ids 10 wide) may follow on the line; _ID and "
         "_JOBID (a prefix of file names) have no effect"}};

const RegisterKeyword<DeckLevel> title_keyword{
    {.names = {"TITLE"},
     .purpose = "title of the run",
     .cards = {{.fields = {{"TITLE", &DeckLevel::text, "-", "one line of text", {.width = 80}}}}}}};

const RegisterKeyword<DeckLevel> end_keyword{
    {.names = {"END"}, .purpose = "ends a file; what follows is not read"}};

const RegisterKeyword<DeckLevel> comment_keyword{
    {.names = {"COMMENT"}, .purpose = "lines of text up to the next keyword, without effect"}};

const RegisterKeyword<DeckLevel> parameter_keyword{
    {.names = {"PARAMETER"},
     .purpose = "numbers with a name, used as &name or -&name in any field; up to four pairs per line",
     .cards = {
         {.fields = {{"PRMR", &DeckLevel::text, "-", "type letter (R real, I integer) and name"},
                     {"VAL", &DeckLevel::text, "-", "value, or a reference to an earlier parameter"}}}}}};

}  // namespace

}  // namespace courant

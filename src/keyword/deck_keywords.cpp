// Keywords that shape the deck itself. read_deck handles them by name; the tables are for the documentation.
#include "keyword/deck_cards.hpp"
#include "keyword/read/parameters.hpp"
#include "keyword/registry.hpp"

namespace courant {

namespace {

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

const RegisterKeyword<DeckLevel> case_keyword{
    {.names = {"CASE", "CASE_BEGIN", "CASE_END"},
     .purpose = "several runs of one deck, one after the other, each in a folder of its own in that of the "
                "results, named JOBID or CASE and the id. What is between *CASE_BEGIN_n and *CASE_END_n "
                "counts in the cases that name n as SCID; within blocks of several n, in those that name one "
                "of them. Without *CASE each n is a case. `courant run --case ID` computes that one alone",
     .cards = {{.fields = {{"CASEID", &DeckLevel::text, "-", "id"},
                           {"JOBID", &DeckLevel::text, "-", "name, without blanks", {.width = 70}}}},
               {.fields = {{"COMMANDS", &DeckLevel::text, "-", "blank", {.width = 80}}}},
               {.fields = {{"SCID1", &DeckLevel::text, "-", "n of its blocks, up to the next keyword"}}}}}};

const RegisterKeyword<DeckLevel> parameter_keyword{
    {.names = {"PARAMETER", "PARAMETER_LOCAL", "PARAMETER_GLOBAL", "PARAMETER_MUTABLE", "PARAMETER_NOECHO"},
     .purpose = "names for values, used as &name or -&name in any field; up to four pairs per line. Names do "
                "not distinguish upper and lower case. A parameter is known below its definition, in all "
                "files; with _LOCAL in this file and those that it includes. _MUTABLE: later definitions may "
                "change it. Options may be combined in any order",
     .cards = {
         {.fields = {{"PRMR", &DeckLevel::text, "-", "type letter (R real, I integer, C text) and name"},
                     {"VAL", &DeckLevel::text, "-",
                      "value, &name or -&name of an earlier parameter, or <expression>"}}}}}};

const RegisterKeyword<DeckLevel> parameter_expression_keyword{
    {.names = {"PARAMETER_EXPRESSION", "PARAMETER_EXPRESSION_LOCAL", "PARAMETER_EXPRESSION_GLOBAL",
               "PARAMETER_EXPRESSION_MUTABLE", "PARAMETER_EXPRESSION_NOECHO"},
     .purpose = "a parameter computed from earlier ones, one per line; lines whose first ten columns are "
                "blank continue it. Of integers + - * / ** give integers (5/2 is 2); functions: sin cos tan "
                "csc sec ctn asin acos atan atan2 sinh cosh tanh asinh acosh atanh min max sqrt mod abs sign "
                "int aint nint anint float exp log log10 LS_INTEGER LS_REAL",
     .cards = {{.fields = {{"PRMR", &DeckLevel::text, "-",
                            "type letter (R, I: the result loses its fraction, C: a text) and name"},
                           {"EXPRESSION",
                            &DeckLevel::text,
                            "-",
                            "numbers, names with or without &, operators, parentheses, functions",
                            {.width = 70}}}}}}};

const RegisterKeyword<DeckLevel> parameter_type_keyword{parameter_type_table()};
const RegisterKeyword<ParameterDuplication> parameter_duplication{parameter_duplication_table()};

}  // namespace

}  // namespace courant

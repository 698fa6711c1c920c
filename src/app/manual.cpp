#include "app/manual.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "base/nearest_word.hpp"
#include "base/version.hpp"
#include "output/file.hpp"

namespace courant {

namespace {

std::vector<const CLI::App*> calls_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); });
}

bool takes_value(const CLI::Option& option) {
  return option.get_expected_max() > 0 && option.get_type_size_max() > 0;
}

/// Text as roff takes it: minus signs stay those of the keyboard, and nothing at the start of a line is taken
/// for a request.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return !out.empty() && (out[0] == '.' || out[0] == '\'') ? "\\&" + out : out;
}

std::string option_text(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "-" : ", -") + name;
  for (const std::string& name : option.get_lnames()) names += (names.empty() ? "--" : ", --") + name;
  std::string out = fmt::format(".TP\n.B {}\n", roff(names.empty() ? option.get_name(true) : names));
  if (!names.empty() && takes_value(option))
    out = fmt::format(".TP\n.BI \"{} \" {}\n", roff(names),
                      option.get_type_name().substr(0, option.get_type_name().find(':')));
  return out + roff(option.get_description()) + "\n";
}

std::string synopsis(const CLI::App& call) {
  std::string out = fmt::format(".B courant {}\n", roff(call.get_name()));
  for (const CLI::Option* option : call.get_options())
    if (option->get_positional())
      out += (option->get_required() ? ".I " + option->get_name(true)
                                     : ".RI [ " + option->get_name(true) + " ]") +
             "\n";
  return out + ".RI [ options ]\n";
}

std::string program_text(const CLI::App& app) {
  std::string out =
      ".SH SYNOPSIS\n.B courant\n.I CALL\n.RI [ options ]\n.br\n.B courant i=\\c\n.I DECK\n.RB [ "
      "ncpu=\\c\n.IR "
      "N ]\n"
      ".SH DESCRIPTION\nComputes keyword decks as LS\\-DYNA reads them: particles (SPH), solids, shells, "
      "rigid "
      "bodies, contact.\n.SH CALLS\n";
  for (const CLI::App* call : calls_of(app))
    out +=
        fmt::format(".TP\n.BR courant\\-{} (1)\n{}\n", roff(call->get_name()), roff(call->get_description()));
  return out +
         ".SH EXIT STATUS\n0 done; 1 the input is wrong, nothing was run and nothing written; 2 the run "
         "ended in "
         "error, or its results cannot be trusted; 3 anything else, such as memory that is exhausted.\n";
}

std::string call_text(const CLI::App& call) {
  std::string out = ".SH SYNOPSIS\n" + synopsis(call) +
                    fmt::format(".SH DESCRIPTION\n{}.\n.SH OPTIONS\n", roff(call.get_description()));
  for (const CLI::Option* option : call.get_options()) out += option_text(*option);
  return out + ".SH SEE ALSO\n.BR courant (1)\n";
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

}  // namespace

std::vector<std::string> option_names(const CLI::App& call) {
  std::vector<std::string> names;
  for (const CLI::Option* option : call.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::string unknown_options(const CLI::App& call, const std::vector<std::string>& words) {
  const std::vector<std::string> known = option_names(call);
  std::string out;
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    const std::size_t dashes = name.find_first_not_of('-');
    const bool is_option =
        (dashes == 1 || dashes == 2) && std::isalpha(static_cast<unsigned char>(name[dashes]));
    const bool is_long = std::find(known.begin(), known.end(), "-" + name) != known.end();  // -output
    const auto is_this = [&](const std::string& one) {                                      // -oDIR is -o DIR
      return one == name || (dashes == 1 && !is_long && one.size() == 2 && name.rfind(one, 0) == 0);
    };
    if (!is_option || std::any_of(known.begin(), known.end(), is_this)) continue;
    const std::string near = nearest_word("--" + name.substr(dashes), known);
    out += fmt::format("error: `courant {}` has no option '{}'\n  hint: {}\n", call.get_name(), name,
                       near.empty() ? fmt::format("its options are {}", fmt::join(known, ", "))
                                    : fmt::format("did you mean {}?", near));
  }
  return out;
}

std::string manual_page(const CLI::App& app, const CLI::App& call) {
  const bool whole = &call == &app;
  const std::string name = whole ? "courant" : "courant-" + call.get_name();
  const std::string head = fmt::format(
      ".\\\" Made from the program's own description of its calls.\n.TH {} 1 \"\" \"courant {}\" "
      "\"Courant\"\n"
      ".SH NAME\n{} \\- {}\n",
      roff(name), COURANT_VERSION, roff(name), roff(call.get_description()));
  return head + (whole ? program_text(app) : call_text(call));
}

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> calls;
  std::string cases;
  for (const CLI::App* call : calls_of(app)) {
    calls.push_back(call->get_name());
    cases += fmt::format("    {}) options=\"{}\" ;;\n", call->get_name(), joined(option_names(*call)));
  }
  return fmt::format(
      R"bash(# Completion of courant's calls for bash; made from the program's own description of its calls.
_courant() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" options=""
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W "{} --help --version" -- "$word"))
    return
  fi
  case "${{COMP_WORDS[1]}}" in
{}  esac
  case "$word" in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")); return ;;
  esac
  case "${{COMP_WORDS[1]}}" in
    help) COMPREPLY=($(compgen -W "{}" -- "$word")) ;;
    keywords) COMPREPLY=($(compgen -W "$("${{COMP_WORDS[0]}}" keywords 2>/dev/null | sed -n 's/^\*\([^ ]*\).*/\1/p')" -- "${{word^^}}")) ;;
  esac
}}
complete -o default -F _courant courant
)bash",
      joined(calls), cases, joined(calls));
}

void write_manual(const CLI::App& app, const std::string& folder) {
  const std::filesystem::path to = folder;
  make_folder(to);
  write_file(to / "courant.1", manual_page(app, app));
  for (const CLI::App* call : calls_of(app))
    write_file(to / fmt::format("courant-{}.1", call->get_name()), manual_page(app, *call));
  write_file(to / "courant", bash_completion(app));
}

}  // namespace courant
